#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/communicator.h"
#include "base/error.h"
#include "command/console.h"

namespace svnet {

/// What a program's own arguments have wrong that CLI11 cannot see: exit 2. Throw it with wrong_usage.
class UsageError : public Error {
 public:
  using Error::Error;
};

template <class... Parts>
[[noreturn]] void wrong_usage(const Parts&... parts) {
  throw UsageError(joined(parts...));
}

/// The frame of a program: its arguments, --help, --version, --threads and --quiet, signals, and the one place that
/// catches.
///
///     int main(int argc, char** argv) {
///       Command command("svnet-info", "Says what a file contains.", "svnet-info model.safetensors");
///       std::string file;
///       command.app().add_option("FILE", file, "A weights, features, scores or model file");
///       return command.run(argc, argv, [&](Console& console) { console.result(describe(file)); });
///     }
class Command {
 public:
  /// `example`: one or more command lines that --help shows.
  Command(std::string name, const std::string& description, const std::string& example);

  /// To add the program's arguments to.
  CLI::App& app() { return app_; }

  /// Adds --precision, which stands for SVNET_PRECISION: for programs that run networks of a backbone.
  CLI::Option* add_precision();

  /// Parses, runs `body` and returns the exit status: 0 done, 1 failed (one line on stderr: what, where, what to do),
  /// 2 wrong usage, 130 interrupted. SVNET_MAX_ISA, --threads and --precision are in force when the body runs.
  /// Of a communicator only the first process speaks. Others wait a second with an error: where the first one failed as
  /// well, it ends them before.
  int run(int argc, char** argv, const std::function<void(Console&)>& body,
          const Communicator& communicator = SingleProcess::shared());

 private:
  int parsed(const CLI::ParseError& answer, const Communicator& communicator);
  std::string usage_text(const std::string& message) const;
  int report(Console& console, const std::string& message, int status, const Communicator& communicator) const;

  std::string name_;
  CLI::App app_;
  int threads_ = 0;
  std::string precision_{};
  bool quiet_ = false;
};

}  // namespace svnet
