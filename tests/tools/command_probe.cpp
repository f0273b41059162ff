// A program that does what its argument says. command_test.cpp runs it.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <thread>

#include "base/parallel.h"
#include "command/command.h"

using namespace svnet;
using namespace svnet::command;

namespace {

/// A file that exists as long as this object.
struct TemporaryFile {
  explicit TemporaryFile(std::string name) : path(std::move(name)) { std::ofstream(path) << "half written"; }
  ~TemporaryFile() { std::filesystem::remove(path); }
  std::string path;
};

void work(const std::string& what, const std::string& file, Console& console) {
  const auto& progress = console.messages().progress;
  if (what == "result") {
    console.messages().line("a line\nof\x1b[31m the log");
    console.result("the result");
  } else if (what == "threads") {
    console.result(std::to_string(Parallel::shared().threads()));
  } else if (what == "error") {
    fail("x.yaml:3: seed: wrong,\nin two lines");
  } else if (what == "usage") {
    wrong_usage("either --a or --b");
  } else if (what == "memory") {
    throw std::bad_alloc();
  } else if (what == "file") {
    std::cout << std::filesystem::file_size("/nonexistent");
  } else if (what == "progress") {
    progress("scores", 250, 1000, 2.5);
    console.messages().line("in between");
    progress("scores", 1000, 1000, 8);
    progress("search", 3, 0, 1);
  } else if (what == "log") {
    console.log_to(file);
    console.messages().line("to the file");
    progress("scores", 10, 10, 1);
    fail("the end");
  } else if (what == "wait") {
    const TemporaryFile half(file);
    console.result("ready");
    std::cout.flush();
    for (Index i = 0; i < 3000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      progress("waiting", i, 3000, static_cast<double>(i) / 100);
    }
  } else if (what == "hangup") {
    std::raise(SIGHUP);
    progress("after it", 1, 1, 0);
  } else if (what == "hang") {
    console.result("ready");
    std::cout.flush();
    std::this_thread::sleep_for(std::chrono::seconds(30));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-probe", "Does what it is told.", "svnet-probe result\nsvnet-probe log log.txt");
  std::string what, file;
  command.add("WHAT", what, "What to do").required();
  command.add("FILE", file, "A file");
  return command.run(argc, argv, [&](Console& console) { work(what, file, console); });
}
