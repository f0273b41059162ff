#include "serve/workers.h"

#include <utility>

namespace svnet::serve {

Workers::Workers(Index count) : free_(count) {
  for (Index i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool Workers::try_run(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (free_ == 0) return false;
    --free_;
    tasks_.push_back(std::move(task));
  }
  changed_.notify_one();
  return true;
}

void Workers::work() {
  for (std::unique_lock lock(mutex_);;) {
    changed_.wait(lock, [&] { return stopping_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    const std::function<void()> task = std::move(tasks_.back());
    tasks_.pop_back();
    lock.unlock();
    task();
    lock.lock();
    ++free_;
  }
}

}  // namespace svnet::serve
