#include "base/progress.h"

#include <utility>

namespace svnet {

Progress::Progress(const Messages& messages, std::string task, Index total)
    : messages_(messages), task_(std::move(task)), total_(total), start_(Clock::now()) {}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void Progress::update(Index done) {
  if (!messages_.progress) return;
  const auto now = Clock::now();
  const bool is_last = total_ > 0 && done >= total_;
  if (!is_last && last_ && now - *last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  messages_.progress(task_, done, total_, std::chrono::duration<double>(now - start_).count());
}

}  // namespace svnet
