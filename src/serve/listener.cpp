#include "serve/listener.h"

#include <array>
#include <cerrno>
#include <memory>
#include <system_error>

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/error.h"

namespace svnet::serve {
namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses addresses_of(const std::string& host, const std::string& port) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int failure = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  check(failure == 0, "the host ", host, " has no address: ", ::gai_strerror(failure));
  return {found, &::freeaddrinfo};
}

std::string last_error() { return std::generic_category().message(errno); }

int port_of(int socket) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  check(::getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size) == 0, "no port was bound: ", last_error());
  return ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(bound).sin6_port
                                           : reinterpret_cast<const sockaddr_in&>(bound).sin_port);
}

}  // namespace

Listener::Listener(const std::string& host, Index port) {
  const Addresses addresses = addresses_of(host, std::to_string(port));
  std::string problem;
  for (const addrinfo* at = addresses.get(); at != nullptr && socket_ < 0; at = at->ai_next) {
    const int candidate = ::socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, at->ai_protocol);
    if (candidate < 0) {
      problem = last_error();
      continue;
    }
    const int yes = 1;
    ::setsockopt(candidate, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(candidate, at->ai_addr, at->ai_addrlen) == 0 && ::listen(candidate, SOMAXCONN) == 0) {
      socket_ = candidate;
    } else {
      problem = last_error();
      ::close(candidate);
    }
  }
  check(socket_ >= 0, "port ", port, " of ", host, " cannot be used: ", problem);
  const bool is_ipv6_number = host.find(':') != std::string::npos;
  address_ = joined("http://", is_ipv6_number ? "[" + host + "]" : host, ":", port_of(socket_));
}

Listener::~Listener() { ::close(socket_); }

int Listener::accept(int milliseconds) const {
  pollfd waited{socket_, POLLIN, 0};
  if (::poll(&waited, 1, milliseconds) <= 0) return -1;
  return ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
}

bool is_loopback(const std::string& host) {
  const Addresses addresses = addresses_of(host, "0");
  for (const addrinfo* at = addresses.get(); at != nullptr; at = at->ai_next) {
    if (at->ai_family == AF_INET6) {
      if (!IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(at->ai_addr)->sin6_addr)) return false;
    } else {
      const auto number = ntohl(reinterpret_cast<const sockaddr_in*>(at->ai_addr)->sin_addr.s_addr);
      if (number >> 24 != 127) return false;
    }
  }
  return true;
}

}  // namespace svnet::serve
