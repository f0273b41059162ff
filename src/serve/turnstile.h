#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "base/index.h"

namespace svnet::serve {

using Clock = std::chrono::steady_clock;

/// Lets a number of callers through at the same time, and a number wait, first come, first served. Thread-safe.
class Turnstile {
 public:
  Turnstile(Index at_once, Index waiting) : at_once_(at_once), most_waiting_(waiting) {}
  Turnstile(const Turnstile&) = delete;
  Turnstile& operator=(const Turnstile&) = delete;

  /// A caller's turn, which ends with the object.
  class Turn {
   public:
    explicit Turn(Turnstile& turnstile) : turnstile_(turnstile) {}
    ~Turn() { turnstile_.leave(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    Turnstile& turnstile_;
  };

  /// Waits for a turn. Throws Refusal 503 at once if too many wait, and at `deadline`.
  Turn enter(Clock::time_point deadline);

 private:
  void leave();

  Index at_once_, most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Index inside_ = 0;
  std::deque<const void*> waiting_;  // one entry per caller, first come first
};

}  // namespace svnet::serve
