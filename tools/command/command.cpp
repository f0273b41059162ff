#include "command/command.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <ctime>
#include <exception>
#include <iostream>
#include <new>

#include "base/cpu.h"
#include "base/parallel.h"
#include "base/version.h"
#include "command/help_text.h"
#include "command/interrupt.h"
#include "sandbox/mode.h"

namespace svnet::command {
namespace {

void flush_results() {
  std::cout.flush();
  throw_if_interrupted();
  check(std::cout.good(), "cannot write to standard output, is the disk full?");
}

}  // namespace

Command::Command(std::string name, const std::string& description, const std::string& example)
    : name_(std::move(name)), app_(std::make_unique<CLI::App>(description, name_)) {
  app_->formatter(std::make_shared<HelpText>());
  app_->fallthrough();  // subcommands accept the options below too
  app_->set_version_flag("--version", name_ + " " + kVersion, "Print the version and exit");
  app_->add_option("--threads", threads_,
                   "Number of threads (default: SVNET_THREADS, or all CPUs that the process may use)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app_->add_flag("--quiet", quiet_, "Print results and errors only");
  std::string footer = "Example:";
  for (std::size_t start = 0; start <= example.size();) {
    const std::size_t end = std::min(example.find('\n', start), example.size());
    footer += "\n  " + example.substr(start, end - start);
    start = end + 1;
  }
  app_->footer(footer);
}

Command::~Command() = default;

template <class T>
Argument Command::add(const std::string& name, T& value, const std::string& help) {
  return Argument(app_->add_option(name, value, help));
}
template Argument Command::add(const std::string&, std::string&, const std::string&);
template Argument Command::add(const std::string&, std::filesystem::path&, const std::string&);
template Argument Command::add(const std::string&, Index&, const std::string&);
template Argument Command::add(const std::string&, std::uint64_t&, const std::string&);
template Argument Command::add(const std::string&, double&, const std::string&);
template Argument Command::add(const std::string&, std::vector<std::string>&, const std::string&);
template Argument Command::add(const std::string&, std::vector<std::filesystem::path>&, const std::string&);
template Argument Command::add(const std::string&, std::vector<double>&, const std::string&);

Argument Command::add_flag(const std::string& name, bool& value, const std::string& help) {
  return Argument(app_->add_flag(name, value, help));
}

Argument Command::add_callback(const std::string& name, const std::function<void(const std::string&)>& take,
                               const std::string& help) {
  const auto checked = [take](const std::string& text) {
    try {
      take(text);
    } catch (const Error& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  return Argument(app_->add_option_function<std::string>(name, checked, help));
}

Argument Command::add_precision(bool has_int8) {
  const std::string int8 = has_int8 ? " int8 is still faster and less exact, runs everywhere, and takes ranges of "
                                      "activations from pictures"
                                    : "";
  const Argument argument = add("--precision", precision_,
                                "Precision of the network's products. bf16 is faster and less exact; it needs a "
                                "processor with AVX512-BF16." +
                                    int8 + " (default: SVNET_PRECISION, or f32)");
  if (has_int8) return argument.one_of({"f32", "bf16", "int8"}).value_name("f32|bf16|int8");
  return argument.one_of({"f32", "bf16"}).value_name("f32|bf16");
}

Argument Command::add_sandbox() {
  return add_callback(
             "--sandbox",
             [](const std::string& text) { sandbox::set_mode(enum_from_name<sandbox::Mode>("--sandbox", text)); },
             "on: files that libraries decode (HDF5, meshes) are read in a process that can do nothing else. off: in "
             "this one, for files that you trust (default: on)")
      .value_name("on|off");
}

int Command::run(int argc, char** argv, const std::function<void(Console&)>& body, const Communicator& communicator) {
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the file size limit fails with EFBIG; it does not kill the process
  if (const std::optional<int> status = parse(argc, argv, communicator)) return *status;
  Console console(communicator.is_root() ? (quiet_ ? Console::Verbosity::quiet : Console::Verbosity::normal)
                                         : Console::Verbosity::errors_only,
                  stderr_is_terminal());
  try {
    remember_interrupts();
    cap_from_environment();
    if (threads_ > 0) Parallel::shared().resize(threads_);
    body(console);
    console.end_task();
    flush_results();
    return 0;
  } catch (const Interrupted&) {
    if (communicator.size() > 1) return 130;  // the launcher interrupted all processes and says so
    return report(console, "interrupted", 130, communicator);
  } catch (const UsageError& e) {
    return report(console, usage_text(e.what()), 2, communicator);
  } catch (const NoMemory& e) {
    return report(console, e.what(), 1, communicator);
  } catch (const std::bad_alloc&) {
    return report(console, "out of memory", 1, communicator);
  } catch (const std::exception& e) {
    return report(console, e.what(), 1, communicator);
  }
}

std::optional<int> Command::parse(int argc, char** argv, const Communicator& communicator) {
  try {
    app_->parse(argc, argv);
    return {};
  } catch (const CLI::ParseError& answer) {
    Console console(Console::Verbosity::normal, stderr_is_terminal());
    if (answer.get_exit_code() != 0) return report(console, usage_text(answer.what()), 2, communicator);
    if (!communicator.is_root()) return 0;
    app_->exit(answer, std::cout, std::cerr);
    try {
      flush_results();
      return 0;
    } catch (const Error& e) {
      return report(console, e.what(), 1, communicator);
    }
  }
}

std::string Command::usage_text(const std::string& message) const { return message + "; see " + name_ + " --help"; }

int Command::report(Console& console, const std::string& message, int status, const Communicator& communicator) const {
  const timespec wait{5, 0};  // on a busy machine the root process takes seconds to end the others
  if (!communicator.is_root() && ::nanosleep(&wait, nullptr) != 0) return status;  // a signal ended the wait
  console.error(name_ + ": " + message);
  return status;
}

}  // namespace svnet::command
