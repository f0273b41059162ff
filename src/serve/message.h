#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "serve/limits.h"

namespace svnet::serve {

/// Names and values in the order of the request; a name may repeat.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A request whose body may not have been read yet.
struct Request {
  std::string method;  // "GET"
  std::string path;    // "/v1/model", decoded, without the query
  Fields parameters;   // of the query, decoded
  Fields headers;      // names in lower case
  /// Reads the body, of a size that body_size() has accepted. Throws Refusal 400 if it ends early, 408 if it is slow.
  std::function<std::string(std::size_t bytes)> read_body;

  /// The value of a header, given in lower case; empty if it is missing. Throws Refusal 400 if it is there twice.
  std::optional<std::string> header(const std::string& name) const;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body{};
  Fields headers{};  // besides Content-Type, Content-Length, and those that every answer has
};

/// The size of the request's body. Throws Refusal 411 without Content-Length, 400 if it is no number, 413 above
/// `most_bytes`, and 415 if the body is compressed.
std::size_t body_size(const Request&, std::size_t most_bytes);

/// {"error": message} in one line.
Response error_response(int status, const std::string& message);

}  // namespace svnet::serve
