#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/text.h"
#include "base/version.h"
#include "command/number_check.h"
#include "command/progress_text.h"
#include "shell.h"

using namespace svnet;
using namespace svnet::command;

namespace {

/// Runs the probe through the shell, with `prefix` before it.
Ran run(const std::string& arguments, const std::string& prefix = "") {
  return run_shell(".", prefix + " " COMMAND_PROBE " " + arguments);
}

/// The probe as a child whose output can be read while it runs: through a pipe, or a terminal for stdout and stderr.
class Child {
 public:
  Child(const std::string& what, const std::string& file, bool terminal) {
    int ends[2] = {-1, -1};
    if (!terminal && ::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = terminal ? ::forkpty(&output_, nullptr, nullptr, nullptr) : ::fork();
    if (pid_ < 0) throw std::runtime_error("no child");
    if (pid_ == 0) {
      if (!terminal) ::dup2(ends[1], STDOUT_FILENO), ::dup2(ends[1], STDERR_FILENO);
      for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
      ::execl("/usr/bin/env", "env", "TERM=xterm", COMMAND_PROBE, what.c_str(), file.empty() ? nullptr : file.c_str(),
              nullptr);
      ::_exit(127);
    }
    if (!terminal) ::close(ends[1]), output_ = ends[0];
  }
  ~Child() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
    ::close(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Returns the output up to and including `text`, or to its end.
  std::string read_to(const std::string& text) {
    std::string seen;
    char c = 0;
    while ((text.empty() || seen.find(text) == std::string::npos) && ::read(output_, &c, 1) == 1) seen += c;
    return seen;
  }
  void signal(int number) const { ::kill(pid_, number); }
  /// Waits for the end. Returns the exit status, or minus the signal that ended the child.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
  int output_ = -1;
};

bool has_control_characters(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; });
}

}  // namespace

TEST_CASE("every command has --help with an example, and --version") {
  const Ran help = run("--help");
  CHECK(help.status == 0);
  CHECK(help.err.empty());
  for (const char* part : {"Does what it is told.", "Usage: svnet-probe [OPTIONS] WHAT [FILE]", "--threads", "--quiet",
                           "--version", "Example:\n  svnet-probe result\n  svnet-probe log log.txt\n"})
    CHECK_THAT(help.out, Catch::Contains(part));
  for (std::size_t start = 0, end; (end = help.out.find('\n', start)) != std::string::npos; start = end + 1)
    CHECK(end - start <= 80);
  CHECK(run("--version").out == std::string("svnet-probe ") + kVersion + "\n");
  CHECK(run("--version").status == 0);
}

TEST_CASE("numbers out of range are refused, NaN and infinities among them") {
  const auto problem = [](const CLI::Validator& check, std::string text) { return check(text); };
  CHECK(problem(positive_number(), "1e-300").empty());
  CHECK(problem(positive_number(), "0") == "0 is out of range, must be greater than 0");
  CHECK(problem(non_negative_number(), "0").empty());
  CHECK(problem(non_negative_number(), "-1e-9") == "-1e-9 is out of range, must be at least 0");
  for (const char* inside : {"0.5", "30"}) CHECK(problem(number_between(0.5, 30), inside).empty());
  for (const char* outside : {"0.49", "30.1"})
    CHECK(problem(number_between(0.5, 30), outside) == std::string(outside) + " is out of range, must be 0.5 to 30");
  for (const CLI::Validator& check : {positive_number(), non_negative_number(), number_between(0, 1)}) {
    for (const char* text : {"nan", "-nan", "inf", "-inf", "1e999"}) CHECK_FALSE(problem(check, text).empty());
    for (const char* text : {"", "one", "1x"})
      CHECK(problem(check, text) == "'" + std::string(text) + "' is not a number");
  }
}

TEST_CASE("wrong usage is exit 2 with a message") {
  for (const char* arguments :
       {"", "--colour", "result --threads 0", "result --threads many", "result --threads 1025", "a b c"}) {
    INFO(arguments);
    const Ran ran = run(arguments);
    CHECK(ran.status == 2);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err, Catch::StartsWith("svnet-probe: ") && Catch::EndsWith("; see svnet-probe --help\n"));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  }
  CHECK(run("").err == "svnet-probe: WHAT is required; see svnet-probe --help\n");
  CHECK_THAT(run("result --threads 0").err, Catch::StartsWith("svnet-probe: --threads: "));
  CHECK(run("usage").status == 2);
  CHECK(run("usage").err == "svnet-probe: either --a or --b; see svnet-probe --help\n");
}

TEST_CASE("failures are exit 1 with one line") {
  const auto fails_with = [](const Ran& ran, const std::string& message) {
    CHECK(ran.status == 1);
    CHECK(ran.out.empty());
    CHECK(ran.err == "svnet-probe: " + message + "\n");
  };
  fails_with(run("error"), "x.yaml:3: seed: wrong, in two lines");
  fails_with(run("error --quiet"), "x.yaml:3: seed: wrong, in two lines");
  fails_with(run("memory"), "out of memory");
  fails_with(run("file"), "filesystem error: cannot get file size: No such file or directory [/nonexistent]");
  const Ran isa = run("result", "SVNET_MAX_ISA=avx9");
  CHECK(isa.status == 1);
  CHECK_THAT(isa.err, Catch::StartsWith("svnet-probe: [instruction set] this machine has no 'avx9'"));
  CHECK(run("threads", "SVNET_THREADS=many").err == "svnet-probe: [SVNET_THREADS] 'many' is not a whole number\n");
}

TEST_CASE("results go to stdout, the log to stderr without control characters") {
  const Ran ran = run("result");
  CHECK(ran.status == 0);
  CHECK(ran.out == "the result\n");
  CHECK(ran.err == "a line of?[31m the log\n");
  const Ran quiet = run("result --quiet");
  CHECK(quiet.out == "the result\n");
  CHECK(quiet.err.empty());
}

TEST_CASE("a result that cannot be written is a failure") {
  for (const char* arguments : {"result --quiet", "--help", "--version"}) {
    INFO(arguments);
    const TemporaryFolder folder;
    const std::string err = folder.path() / "err";
    const int status = std::system((std::string(COMMAND_PROBE " ") + arguments + " >/dev/full 2>" + err).c_str());
    CHECK(WEXITSTATUS(status) == 1);
    CHECK(file_contents(err) == "svnet-probe: cannot write to standard output, is the disk full?\n");
  }
}

TEST_CASE("the option --threads overrides SVNET_THREADS") {
  CHECK(run("threads --threads 3", "SVNET_THREADS=2").out == "3\n");
  CHECK(run("threads", "SVNET_THREADS=2").out == "2\n");
}

TEST_CASE("progress that is not on a terminal is plain lines, one at the end") {
  const Ran ran = run("progress");
  CHECK(ran.status == 0);
  CHECK(ran.err == "in between\nscores: 1000 in 8.0 s\nsearch: 3 in 1.0 s\n");
  CHECK(run("progress --quiet").err.empty());
}

TEST_CASE("progress on a terminal is a bar that is redrawn") {
  Child child("progress", "", true);
  const std::string seen = child.read_to("");
  CHECK(child.wait() == 0);
  CHECK(seen ==
        "\rscores  [######------------------]  25 %, 250/1000, 100/s, 7.5 s left\x1b[K"
        "\r\x1b[Kin between\r\n"
        "scores: 1000 in 8.0 s\r\n"
        "\rsearch  3, 3/s\x1b[K"
        "\r\x1b[Ksearch: 3 in 1.0 s\r\n");
}

TEST_CASE("a log file gets every line with its time, quiet or not, and is appended to") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "run" / "log.txt";
  CHECK(run("log " + file).status == 1);
  CHECK(run("log --quiet " + file).status == 1);
  std::string contents = file_contents(file);
  // Times become "dddd-dd-dd dd:dd:dd".
  for (std::size_t line = 0; line < contents.size(); line = contents.find('\n', line) + 1)
    std::replace_if(
        contents.begin() + static_cast<long>(line), contents.begin() + static_cast<long>(line) + 19,
        [](char c) { return c >= '0' && c <= '9'; }, 'd');
  const std::string time = "dddd-dd-dd dd:dd:dd ";
  const std::string once = time + "to the file\n" + time + "scores: 10 in 1.0 s\n" + time + "svnet-probe: the end\n";
  CHECK(contents == once + once);
  CHECK_THAT(run("log /proc/no/log.txt").err, Catch::StartsWith("svnet-probe: /proc/no: cannot make this folder: "));
  CHECK(run("log " + file + "/log.txt").err == "svnet-probe: " + file + ": is not a folder; give the name of one\n");
  std::filesystem::create_directories(folder.path() / "run2" / "log.txt");
  CHECK_THAT(run("log " + (folder.path() / "run2" / "log.txt").string()).err,
             Catch::Contains("run2/log.txt: cannot open the log file"));
}

TEST_CASE("SIGINT, SIGTERM and SIGHUP unwind: temporary files are removed, exit 130") {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const std::string file = folder.path() / "half";
    Child child("wait", file, false);
    child.read_to("ready\n");
    CHECK(std::filesystem::exists(file));
    child.signal(number);
    const std::string rest = child.read_to("");
    CHECK(child.wait() == 130);
    CHECK(rest == "svnet-probe: interrupted\n");
    CHECK_FALSE(std::filesystem::exists(file));
  }
}

TEST_CASE("a signal that was ignored at the start stays ignored, as nohup needs it") {
  const Ran ran = run("result", "trap '' HUP INT TERM;");
  CHECK(ran.status == 0);
  const TemporaryFolder folder;
  CHECK(std::system(
            ("trap '' HUP; " COMMAND_PROBE " hangup " + (folder.path() / "x").string() + " >/dev/null 2>&1").c_str()) ==
        0);
}

TEST_CASE("the second Ctrl-C ends a command that does not check for the first") {
  Child child("hang", "", false);
  child.read_to("ready\n");
  child.signal(SIGINT);
  // Wait until the handler of the first signal has run.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  child.signal(SIGINT);
  CHECK(child.wait() == -SIGINT);
}

TEST_CASE("progress texts") {
  CHECK(duration_text(8.23) == "8.2 s");
  CHECK(duration_text(59.96) == "1 min 0 s");
  CHECK(duration_text(200) == "3 min 20 s");
  CHECK(duration_text(7500) == "2 h 5 min");
  CHECK(plain_progress({"scores", 830, 1440, 6.8}) == "scores: 57 %, 830/1440, 122/s, 5.0 s left");
  CHECK(plain_progress({"epochs", 1, 4, 30}) == "epochs: 25 %, 1/4, 30.0 s each, 1 min 30 s left");
  CHECK(plain_progress({"epochs", 0, 4, 30}) == "epochs: 0 %, 0/4");
  CHECK(plain_progress({"search", 12, 0, 4}) == "search: 12, 3/s");
  CHECK(final_progress({"scores", 3, 9, 4}) == "scores: 3 of 9 in 4.0 s");
  const TaskState state{"größe", 5, 10, 1};
  for (int columns = 0; columns < 80; ++columns) {
    const std::string bar = progress_bar(state, columns);
    CHECK(static_cast<int>(bar.size()) <= std::max(columns - 1, 0));
    CHECK((bar.empty() || (bar.back() & 0xC0) != 0xC0));  // no incomplete character at the end
  }
  CHECK_FALSE(has_control_characters(progress_bar(state, 80)));
  CHECK(printable("a\tb\x7f\x1b\r\n") == "a b??  ");
}
