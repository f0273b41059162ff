// svnet_set_log: one callback for the process.
#include "log.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <shared_mutex>

#include "base/text.h"
#include "guard.h"

namespace svnet {
namespace {

struct Log {
  std::shared_mutex mutex;  // held shared during a callback, so that svnet_set_log returns after the last one
  svnet_log_callback callback = nullptr;
  void* user_data = nullptr;
};

/// Never destroyed: other threads may log while the process ends.
Log& the_log() {
  static Log* log = new Log;
  return *log;
}

std::atomic<bool> has_callback{false};
thread_local bool inside_callback = false;

}  // namespace

bool is_logging() noexcept { return has_callback.load(std::memory_order_relaxed) && !inside_callback; }

void log_line(svnet_log_level level, const std::string& line) {
  if (!is_logging()) return;
  std::string text = line;
  std::ranges::transform(text, text.begin(), [](char c) { return printable(c); });
  Log& log = the_log();
  const std::shared_lock lock(log.mutex);
  if (log.callback == nullptr) return;
  inside_callback = true;
  log.callback(level, text.c_str(), log.user_data);
  inside_callback = false;
}

}  // namespace svnet

svnet_status svnet_set_log(svnet_log_callback callback, void* user_data) {
  using namespace svnet;
  return guarded(SVNET_INVALID_ARGUMENT, [&] {
    check(!inside_callback, "[svnet_set_log] was called from within the callback, which it would wait for");
    Log& log = the_log();
    const std::unique_lock lock(log.mutex);
    log.callback = callback;
    log.user_data = user_data;
    has_callback.store(callback != nullptr, std::memory_order_relaxed);
  });
}
