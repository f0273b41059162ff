#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "base/error.h"
#include "command/argument.h"
#include "command/console.h"

namespace svnet::command {

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
///       command.add("FILE", file, "A weights, features, scores or model file");
///       return command.run(argc, argv, [&](Console& console) { console.result(describe(file)); });
///     }
class Command {
 public:
  /// `example`: command lines for --help, separated by line breaks.
  Command(std::string name, const std::string& description, const std::string& example);

  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Adds an argument of the program, whose value parsing puts into `value`: an option if the name begins with "--". T
  /// is std::string, std::filesystem::path, Index, std::uint64_t, double, or a vector of strings, paths or doubles.
  template <class T>
  Argument add(const std::string& name, T& value, const std::string& help);
  /// An option without a value.
  Argument add_flag(const std::string& name, bool& value, const std::string& help);
  /// An option whose text is passed to `take`, which throws Error if the text is wrong.
  Argument add_callback(const std::string& name, const std::function<void(const std::string&)>& take,
                        const std::string& help);

  /// Adds --precision, which overrides SVNET_PRECISION. For programs that run a backbone. has_int8: the program can
  /// find ranges of activations.
  Argument add_precision(bool has_int8 = false);
  /// "f32", "bf16" or "int8", "" if it was not given.
  const std::string& precision() const { return precision_; }

  /// Adds --sandbox, which sets sandbox::mode(). For programs that read files which libraries decode.
  Argument add_sandbox();

  /// Parses the arguments and runs `body`. SVNET_MAX_ISA and --threads are in force while it runs.
  ///
  /// Returns the exit status: 0 done, 1 failed (one line on stderr says what, where and what to do), 2 wrong usage,
  /// 130 interrupted.
  ///
  /// In a communicator only the root process prints results and progress. If another process fails, it waits five
  /// seconds before it prints its error: if the root process fails too, it ends all processes in that time, and the
  /// error appears once.
  int run(int argc, char** argv, const std::function<void(Console&)>& body,
          const Communicator& communicator = SingleProcess::shared());

 private:
  /// Returns the exit status if there is nothing to run: after --help, --version or wrong usage.
  std::optional<int> parse(int argc, char** argv, const Communicator& communicator);
  std::string usage_text(const std::string& message) const;
  int report(Console& console, const std::string& message, int status, const Communicator& communicator) const;

  std::string name_;
  std::unique_ptr<CLI::App> app_;
  int threads_ = 0;
  std::string precision_{};
  bool quiet_ = false;
};

}  // namespace svnet::command
