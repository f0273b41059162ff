#pragma once
#include <string>

#include "base/index.h"

namespace svnet::serve {

/// A TCP socket that takes connections. Not thread-safe.
class Listener {
 public:
  /// `host`: a name or address; `port` 0: any that is free. Throws Error that names both if they cannot be used.
  Listener(const std::string& host, Index port);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// "http://127.0.0.1:8080"
  const std::string& address() const { return address_; }

  /// Waits for a connection up to `milliseconds`. Its socket, which is the caller's; -1 if none came.
  int accept(int milliseconds) const;

 private:
  int socket_ = -1;
  std::string address_;
};

/// Whether all addresses of a host are this machine's own (127.0.0.0/8, ::1). Throws Error if it has none.
bool is_loopback(const std::string& host);

}  // namespace svnet::serve
