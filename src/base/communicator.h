#pragma once
#include <cstdint>
#include <span>

namespace svnet {

/// Processes that share one job. Requires: every process of a communicator makes the same calls in the same order.
class Communicator {
 public:
  virtual ~Communicator() = default;
  /// The index of this process, in [0, size()).
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Replaces each value by its sum over the processes. Requires: the same number of values in every process.
  virtual void all_reduce(std::span<std::uint64_t> values) = 0;
  /// The same for floats. Requires: at each index, all processes but one hold 0. The sum keeps every bit.
  virtual void all_reduce(std::span<float> values) = 0;
  /// Returns, in every process, the value that the root process passed.
  virtual std::uint64_t broadcast(std::uint64_t value) = 0;
  /// Returns once every process has called it.
  virtual void barrier() { static_cast<void>(broadcast(0)); }
  /// The root process, of rank 0, writes files and reports progress.
  bool is_root() const { return rank() == 0; }
};

/// The communicator of a program that runs as a single process.
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

/// The part [first, last) of a range that one process works on. Shares are contiguous and in the order of ranks. Their
/// sizes differ by at most 1.
struct Share {
  std::uint64_t first, last;
};
inline Share share_of(const Communicator& communicator, std::uint64_t first, std::uint64_t last) {
  const std::uint64_t rank = communicator.rank(), size = communicator.size();
  const std::uint64_t whole = (last - first) / size, rest = (last - first) % size;
  const auto border = [&](std::uint64_t r) { return first + r * whole + (r < rest ? r : rest); };
  return {border(rank), border(rank + 1)};
}

}  // namespace svnet
