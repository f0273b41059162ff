// A whole request as a client sends it, over a pair of local sockets: parsing, guard, routes, prediction and answer.
#include <sys/socket.h>

#include "fuzz_target.h"
#include "serve/connection.h"
#include "serve/http_exchange.h"
#include "serve/routes.h"
#include "small_model.h"

using namespace svnet;
using namespace svnet::fuzz;

namespace {

serve::Limits small_limits() {
  serve::Limits limits;
  limits.body_bytes = std::size_t{1} << 20;
  limits.seconds = limits.header_seconds = 5;
  return limits;
}

serve::Routes& routes() {
  static serve::Routes made(small_axis_model(), {}, small_limits(), serve::Guard{"", {"localhost"}});
  return made;
}

std::string received(int socket) {
  std::string all;
  char piece[65536];
  for (ssize_t got; (got = ::recv(socket, piece, sizeof piece, MSG_DONTWAIT)) > 0;)
    all.append(piece, static_cast<std::size_t>(got));
  return all;
}

}  // namespace

SVNET_FUZZ_TARGET(http) {
  if (input.size() > 65536) return;  // what a socket takes without a reader
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) != 0) report("no sockets");
  if (::send(ends[1], input.data(), input.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(input.size()))
    report("the request was not sent");
  ::shutdown(ends[1], SHUT_WR);
  static const std::atomic<bool> stopping{false};
  static const serve::Limits limits = small_limits();
  {
    serve::Connection connection(ends[0], limits, stopping);
    serve::http_exchange(connection, [](const serve::Request& request) {
      serve::Response response = routes().answer(request);
      if (response.status == 500) report("status 500: " + response.body);
      return response;
    });
  }
  const std::string answer = received(ends[1]);
  ::close(ends[1]);
  if (!input.empty() && !answer.starts_with("HTTP/1.1 ")) report("no answer");
}
