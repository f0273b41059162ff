#include "serve/turnstile.h"

#include <algorithm>

#include "serve/refusal.h"

namespace svnet::serve {

Turnstile::Turn Turnstile::enter(Clock::time_point deadline, std::uint64_t weight) {
  std::unique_lock lock(mutex_);
  const char caller = 0;  // its address is this caller's name
  const bool must_wait = inside_ + weight > capacity_ || !waiting_.empty();
  expect(!must_wait || static_cast<Index>(waiting_.size()) < most_waiting_, 503, "the server is busy; try again");
  waiting_.push_back(&caller);
  const bool is_turn =
      changed_.wait_until(lock, deadline, [&] { return inside_ + weight <= capacity_ && waiting_.front() == &caller; });
  waiting_.erase(std::ranges::find(waiting_, static_cast<const void*>(&caller)));
  if (is_turn) inside_ += weight;
  changed_.notify_all();
  expect(is_turn, 503, "the server is busy; try again");
  return {*this, weight};
}

void Turnstile::leave(std::uint64_t weight) {
  const std::lock_guard lock(mutex_);
  inside_ -= weight;
  changed_.notify_all();
}

}  // namespace svnet::serve
