#include "io/files/atomic_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
namespace fs = std::filesystem;

namespace {
std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
}  // namespace

TEST_CASE("a file is written, then replaced, and no other file remains") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "model.safetensors";
  write_atomically(path, std::string_view("first\0one", 9));
  CHECK(file_contents(path) == std::string("first\0one", 9));
  write_atomically(path, [&](const fs::path& temporary) {
    CHECK(temporary.parent_path() == folder.path());
    CHECK(temporary.filename().string().front() == '.');
    CHECK(file_contents(path).size() == 9);  // readers still see the old file
    std::ofstream(temporary) << "second";
  });
  CHECK(file_contents(path) == "second");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a new file gets the permissions that the umask leaves") {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  write_atomically(folder.path() / "a", "x");
  ::umask(before);
  CHECK(fs::status(folder.path() / "a").permissions() == fs::perms(0640));
}

TEST_CASE("a writer that throws leaves the old file and no temporary") {
  const TemporaryFolder folder;
  const fs::path path = folder.write("scores.h5", "old");
  CHECK_THROWS_WITH(write_atomically(path,
                                     [](const fs::path& temporary) {
                                       std::ofstream(temporary) << "half";
                                       fail("no more scores");
                                     }),
                    "no more scores");
  CHECK(file_contents(path) == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("targets that cannot be written are refused before any work") {
  const TemporaryFolder folder;
  const auto never = [](const fs::path&) { FAIL("the writer was called"); };
  CHECK_THROWS_WITH(write_atomically(folder.path(), never),
                    folder.path().string() + ": cannot be written: it is a folder; give the name of a file");
  const fs::path missing = folder.path() / "none";
  CHECK_THROWS_WITH(write_atomically(missing / "a", never), (missing / "a").string() +
                                                                ": cannot be written: the folder " + missing.string() +
                                                                " does not exist; create it first");
  CHECK_THROWS_WITH(write_atomically("/dev/null", never),
                    "/dev/null: cannot be written: it exists and is not a regular file; give another name");
  const fs::path file = folder.write("file", "");
  CHECK_THROWS_WITH(write_atomically(file / "a", never),
                    (file / "a").string() + ": cannot be written: Not a directory");
  CHECK_THROWS_WITH(write_atomically("", never), "'': not the name of a file; give one that can be written");
}

TEST_CASE("the target of a link is written, and the link stays") {
  const TemporaryFolder folder;
  const fs::path real = folder.write("far/real.h5", "old"), link = folder.path() / "link.h5";
  fs::create_symlink("far/real.h5", link);
  write_atomically(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(file_contents(real) == "new");
  fs::create_symlink("far/none.h5", folder.path() / "dangling");
  write_atomically(folder.path() / "dangling", "made");
  CHECK(file_contents(folder.path() / "far/none.h5") == "made");
  CHECK(entries(folder.path() / "far") == 2);
  fs::create_symlink("round", folder.path() / "round");
  CHECK_THROWS_WITH(write_atomically(folder.path() / "round", "x"),
                    (folder.path() / "round").string() + ": cannot be written: too many symbolic links");
}

TEST_CASE("an output that is also an input is refused, under any name") {
  const TemporaryFolder folder;
  const fs::path input = folder.write("in.h5", "old"), link = folder.path() / "link.h5";
  fs::create_symlink("in.h5", link);
  const auto refusal = [](const fs::path& path) {
    return path.string() + ": cannot be written: the command needs this file for something else; give another name";
  };
  CHECK_THROWS_WITH(check_can_be_written(input, {"", input}), refusal(input));
  CHECK_THROWS_WITH(check_can_be_written(link, {input}), refusal(link));
  const fs::path made = folder.path() / "made", again = folder.path() / "." / "made";
  CHECK_THROWS_WITH(check_can_be_written(again, {made}), refusal(again));
  CHECK_NOTHROW(check_can_be_written(made, {input, folder.path() / "other"}));
}

TEST_CASE("a folder without write permission is an error that says so") {
  if (::geteuid() == 0) {
    WARN("skipped: root may write everywhere");
    return;
  }
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms(0500));
  CHECK_THROWS_WITH(write_atomically(folder.path() / "a", "x"),
                    (folder.path() / "a").string() + ": cannot be written: Permission denied");
  fs::permissions(folder.path(), fs::perms(0700));
}

TEST_CASE("a full disk is an error that names the target and leaves no temporary file") {
  // A limit on file sizes fails in the middle of the contents, like a full disk.
  const TemporaryFolder folder;
  const fs::path path = folder.write("big", "old");
  rlimit before;
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string message;
  try {
    write_atomically(path, std::string(5000, 'x'));
  } catch (const Error& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(message == path.string() + ": cannot be written: File too large");
  CHECK(file_contents(path) == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("the temporary file of a killed process is removed by the next one that writes the file") {
  const TemporaryFolder folder;
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  REQUIRE(::waitpid(dead, nullptr, 0) == dead);
  const auto temporary = [&](const std::string& name, pid_t pid, const std::string& rest) {
    return folder.write(".svnet-" + name + "-" + std::to_string(pid) + rest, "half");
  };
  const fs::path stale = temporary("scores.h5", dead, "-7.tmp");
  const std::vector<fs::path> others{temporary("scores.h5", ::getpid(), "-7000.tmp"),  // of a running process
                                     temporary("scores.h5.bak", dead, "-7.tmp"),       // of another file
                                     temporary("other.h5", dead, "-7.tmp"),
                                     temporary("scores.h5", dead, "-7.tmp.bak"),  // another name
                                     temporary("scores.h5-1", dead, "-7.tmp"),
                                     temporary("scores.h5", dead, "-7"),
                                     folder.write(".svnet-scores.h5-mine.tmp", "mine")};
  write_atomically(folder.path() / "scores.h5", "whole");
  CHECK_FALSE(fs::exists(stale));
  for (const fs::path& other : others) {
    INFO(other);
    CHECK(fs::exists(other));
  }
  CHECK(entries(folder.path()) == others.size() + 1);
}

TEST_CASE("a temporary file does not replace one of the same name") {
  const TemporaryFolder folder;
  // Names that the next temporary files of this process would have.
  std::vector<fs::path> taken;
  for (int i = 0; i < 2000; ++i)
    taken.push_back(folder.write(joined(".svnet-a-", ::getpid(), "-", i, ".tmp"), "taken"));
  write_atomically(folder.path() / "a", "new");
  CHECK(file_contents(folder.path() / "a") == "new");
  CHECK(std::ranges::all_of(taken, [](const fs::path& path) { return file_contents(path) == "taken"; }));
  CHECK(entries(folder.path()) == taken.size() + 1);
}

TEST_CASE("only an existing name can be the standard output") {
  const TemporaryFolder folder;
  CHECK_FALSE(is_standard_output(""));
  CHECK_FALSE(is_standard_output(folder.path() / "none"));
  CHECK_FALSE(is_standard_output(folder.write("file", "")));
  CHECK(is_standard_output("/dev/stdout"));
}

TEST_CASE("names as long as file systems allow can be written") {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_atomically(folder.path() / name, "x");
  CHECK(file_contents(folder.path() / name) == "x");
}

TEST_CASE("a file that is replaced keeps its mode") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("a", "old");
  for (const fs::perms mode : {fs::perms(0600), fs::perms(0664), fs::perms(0755), fs::perms(0400)}) {
    fs::permissions(file, mode);
    write_atomically(file, "new");
    CHECK(fs::status(file).permissions() == mode);
    write_atomically(file, [](const fs::path& temporary) { std::ofstream(temporary) << "more"; });
    CHECK(fs::status(file).permissions() == mode);
  }
}

TEST_CASE("contents in memory may go to a pipe or a device, which stay") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string contents(300000, 'x');
  CHECK_NOTHROW(check_can_be_written(pipe, {}, Streams::allowed));
  CHECK_THROWS(check_can_be_written(pipe));
  std::string received;
  std::thread reader([&] {
    std::ifstream file(pipe, std::ios::binary);
    received.assign(std::istreambuf_iterator<char>(file), {});
  });
  write_atomically(pipe, contents);
  reader.join();
  CHECK(received == contents);
  CHECK(fs::is_fifo(pipe));
  write_atomically("/dev/null", contents);
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a file that cannot get its name is an error, and nothing is left of it") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "result";
  const auto write = [&](const fs::path& temporary) {
    std::ofstream(temporary) << "written";
    fs::create_directories(path / "in the way");  // meanwhile
  };
  CHECK_THROWS_WITH(write_atomically(path, write), Catch::Contains("result: cannot be written: "));
  CHECK(entries(folder.path()) == 1);
  CHECK(fs::is_directory(path));
}
