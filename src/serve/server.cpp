#include "serve/server.h"

#include <atomic>
#include <memory>

#include "serve/connection.h"
#include "serve/workers.h"

namespace svnet::serve {
namespace {

/// How long a wait for a connection lasts at most.
constexpr int kWait_ms = 200;

/// Sets a flag when it goes out of scope.
class SetAtEnd {
 public:
  explicit SetAtEnd(std::atomic<bool>& flag) : flag_(flag) {}
  ~SetAtEnd() { flag_ = true; }
  SetAtEnd(const SetAtEnd&) = delete;
  SetAtEnd& operator=(const SetAtEnd&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace

void serve(const Listener& listener, const Limits& limits, const Answer& answer,
           const std::function<void()>& check_interrupt) {
  std::atomic<bool> stopping = false;
  Workers workers(limits.connections);
  const SetAtEnd stop(stopping);  // before the destructor of workers waits
  for (;;) {
    check_interrupt();
    const int socket = listener.accept(kWait_ms);
    if (socket < 0) continue;
    const auto connection = std::make_shared<Connection>(socket, limits, stopping);
    if (!workers.try_run([connection, &answer] { http_exchange(*connection, answer); })) http_refusal(*connection);
  }
}

}  // namespace svnet::serve
