#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/communicator.h"
#include "base/error.h"
#include "command/console.h"

namespace svnet {

/// A mistake in the arguments that CLI11 cannot see. The program exits with status 2. Thrown through wrong_usage.
class UsageError : public Error {
 public:
  using Error::Error;
};

template <class... Parts>
[[noreturn]] void wrong_usage(const Parts&... parts) {
  throw UsageError(joined(parts...));
}

/// What all programs share: the options --help, --version, --threads and --quiet, signals, exit statuses, and the only
/// place that catches exceptions.
///
///     int main(int argc, char** argv) {
///       Command command("svnet-info", "Says what a file contains.", "svnet-info model.safetensors");
///       std::string file;
///       command.app().add_option("FILE", file, "A weights, features, scores or model file");
///       return command.run(argc, argv, [&](Console& console) { console.result(describe(file)); });
///     }
class Command {
 public:
  /// `example`: command lines for --help, separated by line breaks.
  Command(std::string name, const std::string& description, const std::string& example);

  /// The program adds its own arguments here.
  CLI::App& app() { return app_; }

  /// Adds --precision, which overrides SVNET_PRECISION. For programs that run a backbone.
  CLI::Option* add_precision();

  /// Parses the arguments and runs `body`. SVNET_MAX_ISA, --threads and --precision are in force while it runs.
  ///
  /// Returns the exit status: 0 done, 1 failed (one line on stderr says what, where and what to do), 2 wrong usage,
  /// 130 interrupted.
  ///
  /// In a communicator only the root process prints results and progress. If another process fails, it waits one second
  /// before it prints its error: if the root process fails too, it ends all processes in that second, and the error
  /// appears once.
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
