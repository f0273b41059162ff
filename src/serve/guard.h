#pragma once
#include <string>

#include "serve/message.h"

namespace svnet::serve {

/// Who may ask. Pages and /healthz are open to all who reach the server; /v1/ is not.
struct Guard {
  /// Throws Refusal 401 unless requests for /v1/ carry it as "Authorization: Bearer TOKEN". Empty: no token.
  std::string token;
  /// The host names that requests may give, without port, in lower case. It keeps out a web site that gives its own
  /// name to this machine's address (DNS rebinding), as a token does. Empty: any.
  std::vector<std::string> hosts;

  /// Throws Refusal: 421 for another host, 403 for what a page of another site sends, 401 without the token.
  void check_request(const Request&) const;
};

/// The names of this machine for itself, and `host`.
std::vector<std::string> loopback_hosts(const std::string& host);

}  // namespace svnet::serve
