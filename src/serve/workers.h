#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "base/index.h"

namespace svnet::serve {

/// Threads that run tasks at once, and never queue them. Thread-safe.
class Workers {
 public:
  explicit Workers(Index count);
  /// Waits for the tasks that run.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Runs a task, which must not throw, on a free thread. False if none is free.
  bool try_run(std::function<void()> task);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::function<void()>> tasks_;  // taken by a thread soon: there are never more than free threads
  Index free_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace svnet::serve
