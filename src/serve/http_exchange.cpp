// cpp-httplib parses the request line and headers and writes the answer. What it would do besides is left out, because
// none of its limits bounds a whole request: forms, compression, ranges, keep-alive and its own threads.
#include "serve/http_exchange.h"

#include <httplib.h>

#include "base/text.h"
#include "serve/refusal.h"

namespace svnet::serve {
namespace {

// A page may load its own files, ask its own server and show images that it holds itself; nothing else.
constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const std::vector<std::pair<const char*, const char*>> kHeaders{
    {"Content-Security-Policy", kContentSecurityPolicy},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Permissions-Policy", "camera=(self), microphone=(), geolocation=()"},
    {"Cache-Control", "no-store"},
};

/// A connection as cpp-httplib wants it.
class ConnectionStream : public httplib::Stream {
 public:
  explicit ConnectionStream(Connection& connection) : connection_(connection) {}

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, size_t size) override {
    const std::size_t got = connection_.read(to, size);
    return got > 0 ? static_cast<ssize_t>(got) : -1;
  }
  ssize_t write(const char* from, size_t size) override {
    answered_ = true;
    return connection_.write(from, size) ? static_cast<ssize_t>(size) : -1;
  }
  /// Whether any of the answer was written.
  bool answered() const { return answered_; }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

 private:
  Connection& connection_;
  bool answered_ = false;
};

/// Opens what cpp-httplib keeps for its own loop.
class OneRequestServer : public httplib::Server {
 public:
  using httplib::Server::process_request;
};

std::string body_of(Connection& connection, std::size_t bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::string body;
  while (body.size() < bytes) {
    // In pieces, so that a client must send what it announces before memory is taken for it.
    const std::size_t before = body.size();
    body.resize(before + std::min(bytes - before, kPiece));
    const std::size_t got = connection.read(body.data() + before, body.size() - before);
    body.resize(before + got);
    if (got > 0) continue;
    expect(connection.problem() != Connection::Problem::slow, 408, "the body did not come in time: ", before, " of ",
           bytes, " bytes");
    refuse(400, "the body ends after ", before, " of ", bytes, " bytes");
  }
  return body;
}

/// `is_awaited`: the client waits for "100 Continue" before it sends the body.
Request request_of(const httplib::Request& read, Connection& connection, bool is_awaited) {
  Request request{.method = read.method, .path = read.path, .parameters = {}, .headers = {}, .read_body = {}};
  for (const auto& [name, value] : read.params) request.parameters.emplace_back(name, value);
  for (const auto& [name, value] : read.headers) request.headers.emplace_back(lower_case(name), value);
  request.read_body = [&connection, is_awaited](std::size_t bytes) {
    constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    if (is_awaited) connection.write(kContinue.data(), kContinue.size());
    return body_of(connection, bytes);
  };
  return request;
}

void put(const Response& answer, httplib::Response& to) {
  to.status = answer.status;
  to.body = answer.body;
  to.headers.erase("Content-Type");
  to.set_header("Content-Type", answer.type);
  for (const auto& [name, value] : answer.headers) to.set_header(name, value);
}

/// The answer to a request that cpp-httplib could not parse.
Response parse_error(const Connection& connection, int status) {
  switch (connection.problem()) {
    case Connection::Problem::slow:
      return error_response(408, "the request did not come in time");
    case Connection::Problem::header_too_long:
      return error_response(431, "the request line and headers are too long");
    case Connection::Problem::none:
    case Connection::Problem::closed:
      break;
  }
  if (status == 414) return error_response(414, "the path is too long; send fields as parts of a form");
  return error_response(400, "this is not a request of HTTP/1.1");
}

/// Writes an answer without cpp-httplib, which says nothing before it has read the request line.
void write_answer(Connection& connection, const Response& answer) {
  std::string text = joined("HTTP/1.1 ", answer.status, " Refused\r\nConnection: close\r\nContent-Type: ", answer.type,
                            "\r\nContent-Length: ", answer.body.size(), "\r\n");
  for (const auto& [name, value] : answer.headers) text += joined(name, ": ", value, "\r\n");
  text += "\r\n" + answer.body;
  connection.write(text.data(), text.size());
}

}  // namespace

void http_exchange(Connection& connection, const Answer& answer) {
  OneRequestServer server;
  server.set_default_headers({kHeaders.begin(), kHeaders.end()});
  bool is_routed = false, is_awaited = false;
  server.set_pre_routing_handler([&](const httplib::Request& read, httplib::Response& to) {
    is_routed = true;
    put(answer(request_of(read, connection, is_awaited)), to);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_error_handler([&](const httplib::Request&, httplib::Response& to) {
    if (!is_routed) put(parse_error(connection, to.status), to);
  });
  ConnectionStream stream(connection);
  bool closed = false;
  server.process_request(stream, true, closed, [&](httplib::Request& read) {
    connection.header_is_read();
    is_awaited = read.get_header_value("Expect") == "100-continue";
    read.ranges.clear();
    for (const char* name : {"Accept-Encoding", "Expect"}) read.headers.erase(name);
  });
  if (!stream.answered() && connection.has_begun()) write_answer(connection, parse_error(connection, 400));
  connection.finish();
}

void http_refusal(Connection& connection) {
  write_answer(connection, error_response(503, "the server has no room for another connection; try again"));
}

}  // namespace svnet::serve
