#pragma once
#include <array>
#include <atomic>
#include <cstddef>

#include "serve/limits.h"
#include "serve/turnstile.h"

namespace svnet::serve {

/// One TCP connection, for one request and its answer. Every wait has an end: the time of its phase, or a server that
/// stops. Not thread-safe.
class Connection {
 public:
  /// Takes over a non-blocking socket. `stopping` and limits must outlive the connection.
  Connection(int socket, const Limits& limits, const std::atomic<bool>& stopping);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Why no more bytes come. closed: by the client, or the server stops.
  enum class Problem { none, slow, header_too_long, closed };
  Problem problem() const { return problem_; }
  /// Whether any byte has come.
  bool has_begun() const { return begun_; }

  /// Reads up to `size` bytes, and at least one. 0: there are none, and problem() says why. Before header_is_read()
  /// at most Limits::header_bytes in all.
  std::size_t read(char* to, std::size_t size);
  /// From here on the time is that of the body.
  void header_is_read();

  /// Writes all bytes; false if the client does not take them in time.
  bool write(const char* from, std::size_t size);

  /// Ends the answer. Waits a moment for what the client still sends, since a socket that is closed with unread bytes
  /// resets the connection, and the client may lose the answer.
  void finish();

 private:
  /// Waits for an event of poll(2) until the deadline.
  bool wait(short event, Clock::time_point deadline);
  bool fill();
  Clock::time_point after(double seconds) const;

  int socket_;
  const Limits& limits_;
  const std::atomic<bool>& stopping_;
  Clock::time_point deadline_;
  Problem problem_ = Problem::none;
  bool begun_ = false, in_header_ = true;
  std::size_t header_bytes_ = 0;
  std::array<char, 16384> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // the bytes of buffer_ that are not read yet
};

}  // namespace svnet::serve
