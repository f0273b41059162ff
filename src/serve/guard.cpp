#include "serve/guard.h"

#include <algorithm>

#include "base/text.h"
#include "serve/refusal.h"
#include "serve/token.h"

namespace svnet::serve {
namespace {

/// "::1" of "[::1]:8080", "localhost" of "LocalHost:8080".
std::string host_name(const std::string& header) {
  if (header.starts_with('[')) return lower_case(header.substr(1, header.find(']') - 1));
  return lower_case(header.substr(0, header.find(':')));
}

void check_origin(const Request& request, const std::string& host) {
  const std::string origin = request.header("origin").value_or("http://" + host);
  const std::string site = request.header("sec-fetch-site").value_or("none");
  expect((origin == "http://" + host || origin == "https://" + host) && (site == "none" || site == "same-origin"), 403,
         "a page of another site asks; only this server's own page may");
}

void check_token(const Request& request, const std::string& token) {
  constexpr std::string_view kScheme = "Bearer ";
  const std::string given = request.header("authorization").value_or("");
  expect(given.starts_with(kScheme) && equal_in_constant_time(given.substr(kScheme.size()), token), 401,
         "the token is missing or wrong; send it as Authorization: Bearer TOKEN");
}

}  // namespace

void Guard::check_request(const Request& request) const {
  const std::optional<std::string> host = request.header("host");
  expect(host.has_value(), 400, "the header Host is missing");
  expect(hosts.empty() || std::ranges::find(hosts, host_name(*host)) != hosts.end(), 421,
         "this server does not answer for the host ", printable(*host), "; it is ", joined_with(" or ", hosts));
  if (!request.path.starts_with("/v1/")) return;
  check_origin(request, *host);
  if (!token.empty()) check_token(request, token);
}

std::vector<std::string> loopback_hosts(const std::string& host) {
  std::vector<std::string> hosts{"localhost", "127.0.0.1", "::1"};
  if (std::ranges::find(hosts, lower_case(host)) == hosts.end()) hosts.push_back(lower_case(host));
  return hosts;
}

}  // namespace svnet::serve
