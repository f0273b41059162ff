#include "serve/message.h"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "serve/refusal.h"

namespace svnet::serve {

std::optional<std::string> Request::header(const std::string& name) const {
  std::optional<std::string> found;
  for (const auto& [key, value] : headers) {
    if (key != name) continue;
    expect(!found, 400, "the header ", printable(name), " is there twice");
    found = value;
  }
  return found;
}

std::size_t body_size(const Request& request, std::size_t most_bytes) {
  const std::string encoding = request.header("content-encoding").value_or("identity");
  expect(encoding == "identity", 415, "the body is encoded as ", printable(encoding), "; send it as it is");
  expect(!request.header("transfer-encoding"), 411, "the body has no Content-Length; send it in one piece");
  const std::optional<std::string> text = request.header("content-length");
  expect(text.has_value(), 411, "the header Content-Length is missing");
  std::uint64_t bytes = 0;
  expect(parse_number(*text, bytes), 400, "Content-Length is not a number of bytes");
  expect(bytes <= most_bytes, 413, "the body has ", bytes, " bytes, more than the ", most_bytes,
         " that are read; svnet-serve --max-upload changes that");
  return static_cast<std::size_t>(bytes);
}

Response error_response(int status, const std::string& message) {
  using Json = nlohmann::json;
  const std::string body = Json{{"error", message}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  Response response{.status = status, .body = body + "\n"};
  if (status == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
  if (status == 503) response.headers.emplace_back("Retry-After", "1");
  return response;
}

}  // namespace svnet::serve
