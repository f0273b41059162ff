#pragma once
#include <cstdint>
#include <span>

namespace svnet {

/// Processes that share one piece of work. Every process of a communicator must make the same calls in the same order.
class Communicator {
 public:
  virtual ~Communicator() = default;
  /// Number of this process, in [0, size()).
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Replaces each value by its sum over the processes.
  virtual void all_reduce(std::span<std::uint64_t> values) = 0;
  /// The same for floats. Requires: at most one process holds a value other than 0 at each index, so that the sum keeps
  /// every bit.
  virtual void all_reduce(std::span<float> values) = 0;
  /// Returns the value of the root process, in every process.
  virtual std::uint64_t broadcast(std::uint64_t value) = 0;
  /// Returns once every process has called it.
  virtual void barrier() { static_cast<void>(broadcast(0)); }
  /// The root process reads and writes files and reports progress.
  bool is_root() const { return rank() == 0; }
};

/// The communicator of a program that runs as one process.
class SingleProcess : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void all_reduce(std::span<std::uint64_t>) override {}
  void all_reduce(std::span<float>) override {}
  std::uint64_t broadcast(std::uint64_t value) override { return value; }
  /// An instance for default arguments.
  static SingleProcess& shared() {
    static SingleProcess single_process;
    return single_process;
  }
};

/// The part [first, last) of a range that one process works on. Shares are contiguous, in the order of ranks, and their
/// sizes differ by at most 1.
struct Share {
  std::uint64_t first, last;
};
inline Share share_of(const Communicator& communicator, std::uint64_t first, std::uint64_t last) {
  const auto rank = static_cast<std::uint64_t>(communicator.rank());
  const auto size = static_cast<std::uint64_t>(communicator.size());
  const std::uint64_t whole = (last - first) / size, rest = (last - first) % size;
  const auto border = [&](std::uint64_t r) { return first + r * whole + (r < rest ? r : rest); };
  return {border(rank), border(rank + 1)};
}

}  // namespace svnet
