#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <sys/types.h>

#include "sandbox/channel.h"
#include "sandbox/confine.h"

namespace svnet::sandbox {

/// Whose file is decoded, and by what, as errors call them: "a.h5", "the HDF5 library".
struct Task {
  std::string file;
  std::string decoder;
};

/// A process that this one forked. It is killed when this object ends.
class Process {
 public:
  Process() = default;
  /// What fork returned.
  explicit Process(pid_t id) : id_(id) {}
  ~Process();
  Process(Process&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Process& operator=(Process&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }

  bool exists() const { return id_ > 0; }
  bool is_this() const { return id_ == 0; }
  /// Its status, as waitpid gives it; none if somebody else took it. It must exist, and exists no longer.
  std::optional<int> wait();

 private:
  pid_t id_ = -1;
};

/// A child process that runs one function and can do nothing but use its channel, the descriptors that it was given and
/// a limited amount of memory and time (confine.h). It is a fork without another program, so it begins with a copy of
/// the memory of this process and needs no file. Only the calling thread exists in it: the function must not wait for
/// other threads (no OpenMP, no BLAS). It ends when this object does, or with this process.
///
/// What it sends may come from an attacker who took it over: the receiver checks it as it checks a file.
class Child {
 public:
  /// Throws Error, one line that names `--sandbox off`, if the system has no such processes.
  Child(Task task, std::span<const int> descriptors, const Limits& limits, const std::function<void(Channel&)>& body);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// If the child has ended, the next `receive` says so.
  void send(std::uint32_t kind, std::span<const std::byte> bytes, int descriptor = -1);
  /// The next message. Throws Error, one line that names the file, if the child crashed, was killed for what it tried,
  /// exceeded a limit, or ended; and with the text of an Error that its function threw.
  Message receive();
  /// Throws Error: the child sent what it cannot have read.
  [[noreturn]] void refuse_answer() const;

 private:
  [[noreturn]] void fail_as_child(const std::string& text) const;
  [[noreturn]] void fail_memory() const;
  [[noreturn]] void fail_closed(const ChannelClosed& closed);

  Task task_;
  Limits limits_;
  std::unique_ptr<Bulk> bulk_;
  std::unique_ptr<Channel> channel_;
  Process process_;
};

}  // namespace svnet::sandbox
