#include "serve/connection.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace svnet::serve {
namespace {

/// How often a wait looks whether the server stops.
constexpr int kSlice_ms = 100;
/// How long finish() waits.
constexpr double kLinger_s = 2;

}  // namespace

Connection::Connection(int socket, const Limits& limits, const std::atomic<bool>& stopping)
    : socket_(socket), limits_(limits), stopping_(stopping), deadline_(after(limits.header_seconds)) {}

Connection::~Connection() { ::close(socket_); }

Clock::time_point Connection::after(double seconds) const {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Connection::wait(short event, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) {
      problem_ = Problem::slow;
      return false;
    }
    pollfd waited{socket_, event, 0};
    const int ready = ::poll(&waited, 1, static_cast<int>(std::min<std::int64_t>(left, kSlice_ms)));
    if (ready > 0) return true;
    if ((ready < 0 && errno != EINTR) || (stopping_ && event == POLLIN)) {
      problem_ = Problem::closed;
      return false;
    }
  }
}

bool Connection::fill() {
  for (;;) {
    if (!wait(POLLIN, deadline_)) return false;
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (got > 0) {
      begun_ = true;
      begin_ = 0;
      end_ = static_cast<std::size_t>(got);
      return true;
    }
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    problem_ = Problem::closed;
    return false;
  }
}

std::size_t Connection::read(char* to, std::size_t size) {
  if (problem_ != Problem::none) return 0;
  if (in_header_) {
    if (header_bytes_ >= limits_.header_bytes) {
      problem_ = Problem::header_too_long;
      return 0;
    }
    size = std::min(size, limits_.header_bytes - header_bytes_);
  }
  if (begin_ == end_ && !fill()) return 0;
  const std::size_t taken = std::min(size, end_ - begin_);
  std::memcpy(to, buffer_.data() + begin_, taken);
  begin_ += taken;
  if (in_header_) header_bytes_ += taken;
  return taken;
}

void Connection::header_is_read() {
  in_header_ = false;
  deadline_ = after(limits_.seconds);
}

bool Connection::write(const char* from, std::size_t size) {
  const Clock::time_point deadline = after(limits_.seconds);
  while (size > 0) {
    const ssize_t sent = ::send(socket_, from, size, MSG_NOSIGNAL);
    if (sent > 0) {
      from += sent;
      size -= static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN || errno == EINTR) {
      if (!wait(POLLOUT, deadline)) return false;
    } else {
      return false;
    }
  }
  return true;
}

void Connection::finish() {
  ::shutdown(socket_, SHUT_WR);
  const Clock::time_point deadline = after(kLinger_s);
  while (wait(POLLIN, deadline)) {
    const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) return;
  }
}

}  // namespace svnet::serve
