#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>

#include "base/index.h"

namespace svnet::serve {

using Clock = std::chrono::steady_clock;

/// Lets callers through as long as their weights sum up to no more than a capacity, and lets a number of callers wait,
/// first come, first served. Thread-safe.
class Turnstile {
 public:
  Turnstile(std::uint64_t capacity, Index waiting) : capacity_(capacity), most_waiting_(waiting) {}
  Turnstile(const Turnstile&) = delete;
  Turnstile& operator=(const Turnstile&) = delete;

  /// A caller's turn, which ends with the object.
  class Turn {
   public:
    Turn(Turnstile& turnstile, std::uint64_t weight) : turnstile_(turnstile), weight_(weight) {}
    ~Turn() { turnstile_.leave(weight_); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    Turnstile& turnstile_;
    std::uint64_t weight_;
  };

  /// Waits for a turn. Throws Refusal 503 at once if too many wait, and at `deadline`. Requires weight <= capacity.
  Turn enter(Clock::time_point deadline, std::uint64_t weight = 1);

 private:
  void leave(std::uint64_t weight);

  std::uint64_t capacity_;
  Index most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t inside_ = 0;         // the sum of the weights
  std::deque<const void*> waiting_;  // one entry per caller, first come first
};

}  // namespace svnet::serve
