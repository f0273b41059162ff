#include "io/files/fresh_folder.h"

#include <catch2/catch.hpp>
#include <optional>

#include <unistd.h>

#include "base/error.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;

namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, const std::string& contents) { std::ofstream(path) << contents; }

/// Makes a folder with one file.
void make(const fs::path& path) {
  FreshFolder folder(path);
  write(folder.path() / "file", "new");
  folder.keep();
}

std::string refusal(const fs::path& path) {
  try {
    const FreshFolder folder(path);
    return "made";
  } catch (const Error& error) {
    return error.what();
  }
}

std::ptrdiff_t entries(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

/// Changes the working directory while this object exists.
struct In {
  explicit In(const fs::path& folder) : before(fs::current_path()) { fs::current_path(folder); }
  ~In() { fs::current_path(before); }
  In(const In&) = delete;
  In& operator=(const In&) = delete;
  fs::path before;
};

}  // namespace

TEST_CASE("a fresh folder appears as a whole, or is removed") {
  const TemporaryFolder place;
  {
    FreshFolder folder(place.path() / "a/b/");
    write(folder.path() / "file", "new");
    CHECK_FALSE(fs::exists(place.path() / "a/b"));
    folder.keep();
    CHECK(file_contents(place.path() / "a/b/file") == "new");
  }
  CHECK(entries(place.path() / "a") == 1);
  { const FreshFolder folder(place.path() / "a/c"); }
  CHECK(entries(place.path() / "a") == 1);
}

TEST_CASE("files are added to a fresh folder, each once") {
  const TemporaryFolder place;
  FreshFolder folder(place.path() / "a");
  folder.add("b/c/file", "contents");
  folder.add("empty", "");
  CHECK_THROWS_WITH(folder.add("b/c/file", "again"),
                    (folder.path() / "b/c/file").string() + ": cannot be written: File exists");
  folder.keep();
  CHECK(file_contents(place.path() / "a/b/c/file") == "contents");
  CHECK(file_contents(place.path() / "a/empty").empty());
}

TEST_CASE("a fresh folder does not change what is next to it") {
  const TemporaryFolder place;
  place.write("a.partial/mine", "old");
  make(place.path() / "a");
  CHECK(file_contents(place.path() / "a.partial/mine") == "old");
  CHECK(entries(place.path()) == 2);
}

TEST_CASE("if two processes make the same folder, the first to finish gets it") {
  const TemporaryFolder place;
  const fs::path path = place.path() / "a";
  std::optional<FreshFolder> first(std::in_place, path), second(std::in_place, path);
  CHECK(first->path() != second->path());
  write(first->path() / "file", "first");
  write(second->path() / "file", "second");
  second->keep();
  CHECK_THROWS_WITH(first->keep(), path.string() + ": has come to exist meanwhile; remove it or choose another folder");
  first.reset();
  second.reset();
  CHECK(file_contents(path / "file") == "second");
  CHECK(entries(place.path()) == 1);
}

TEST_CASE("if a file gets the name of a fresh folder meanwhile, it stays") {
  const TemporaryFolder place;
  const fs::path path = place.path() / "a";
  {
    FreshFolder folder(path);
    write(folder.path() / "file", "new");
    write(path, "other");
    CHECK_THROWS_WITH(folder.keep(),
                      path.string() + ": has come to exist meanwhile; remove it or choose another folder");
  }
  CHECK(file_contents(path) == "other");
  CHECK(entries(place.path()) == 1);
}

TEST_CASE("a fresh folder may replace an empty one, and the target of a link") {
  const TemporaryFolder place;
  for (const char* name : {"there", "elsewhere"}) fs::create_directory(place.path() / name);
  fs::create_directory_symlink("elsewhere", place.path() / "link");
  make(place.path() / "there");
  make(place.path() / "link");
  CHECK(fs::exists(place.path() / "there/file"));
  CHECK(fs::exists(place.path() / "elsewhere/file"));
  CHECK(fs::is_symlink(place.path() / "link"));
  CHECK(entries(place.path()) == 3);
}

TEST_CASE("a fresh folder that could not get its final name is refused at once") {
  const TemporaryFolder place;
  const In in(place.path());
  place.write("full/file", "old");
  place.write("empty_file", "");
  fs::create_directory("here");
  fs::create_symlink("nothing", "dangling");
  CHECK(refusal("full") == "full: exists already, remove it or choose another folder");
  CHECK(refusal("empty_file") == "empty_file: exists already, remove it or choose another folder");
  CHECK(refusal("dangling") == "dangling: is a link to nothing; remove it or choose another folder");
  CHECK(refusal("") == "'': not the name of a folder; give one that can be made");
  CHECK(refusal(".") == ".: is the folder that this runs in; choose another one");
  CHECK(refusal("full/file/x") == "full/file/x: cannot be made: Not a directory");
  CHECK(refusal("/proc/svnet") == "/proc/svnet: cannot be made: No such file or directory");
  const std::string long_name(300, 'x');
  CHECK(refusal(long_name) == long_name + ": cannot be made: File name too long");
  {
    const In deeper("here");
    CHECK(refusal("../here") == "../here: is the folder that this runs in; choose another one");
  }
  CHECK(entries(place.path()) == 4);
}
