#pragma once
#include <cstdint>
#include <span>

namespace svnet {

/// Processes that work on the same thing, each on its share. All of them must make the same calls in the same order.
class Team {
 public:
  virtual ~Team() = default;
  virtual int rank() const = 0;  ///< of this process, from 0
  virtual int size() const = 0;
  /// Each value becomes the sum over the processes.
  virtual void sum(std::span<std::uint64_t> values) = 0;
  /// The same: floats that exactly one process has and the others hold as 0.
  virtual void gather(std::span<float> values) = 0;
  /// What process 0 says.
  virtual std::uint64_t from_first(std::uint64_t value) = 0;
  bool first() const { return rank() == 0; }  ///< the one that speaks and writes files
};

/// A process that works alone.
class Alone : public Team {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void sum(std::span<std::uint64_t>) override {}
  void gather(std::span<float>) override {}
  std::uint64_t from_first(std::uint64_t value) override { return value; }
  /// For who has no team.
  static Alone& shared() {
    static Alone alone;
    return alone;
  }
};

/// The part of [first, last) that is a process's share: contiguous, in the order of ranks, as equal as possible.
struct Share {
  std::uint64_t first, last;
};
inline Share share_of(const Team& team, std::uint64_t first, std::uint64_t last) {
  const auto rank = static_cast<std::uint64_t>(team.rank()), size = static_cast<std::uint64_t>(team.size());
  const std::uint64_t whole = (last - first) / size, rest = (last - first) % size;
  const auto border = [&](std::uint64_t r) { return first + r * whole + (r < rest ? r : rest); };
  return {border(rank), border(rank + 1)};
}

}  // namespace svnet
