#pragma once
#include <catch2/catch.hpp>
#include <string>

#include "serve/message.h"
#include "serve/refusal.h"

/// A request of the server's own page, whose body is `body`.
inline svnet::serve::Request request_for(const std::string& method, const std::string& path,
                                         const std::string& body = "", const std::string& type = "image/png") {
  svnet::serve::Request request{.method = method,
                                .path = path,
                                .parameters = {},
                                .headers = {{"host", "localhost:8080"}},
                                .read_body = [body](std::size_t bytes) { return body.substr(0, bytes); }};
  if (method == "POST") {
    request.headers.emplace_back("content-type", type);
    request.headers.emplace_back("content-length", std::to_string(body.size()));
  }
  return request;
}

/// The status and message of the Refusal that `action` throws: "400 …"; "" if it throws none.
template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const svnet::serve::Refusal& refusal) {
    return std::to_string(refusal.status()) + " " + refusal.what();
  }
  return "";
}
