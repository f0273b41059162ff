#pragma once
#include <functional>

#include "serve/connection.h"
#include "serve/message.h"

namespace svnet::serve {

using Answer = std::function<Response(const Request&)>;

/// Reads one request from the connection, has it answered, writes the answer and ends the connection. A request that
/// cannot be read is answered with status 400, 408 (slow), 414 (long path) or 431 (long header). Every answer has the
/// headers that keep browsers from loading anything of other servers, and from being framed.
void http_exchange(Connection&, const Answer&);

/// Answers 503 without reading the request.
void http_refusal(Connection&);

}  // namespace svnet::serve
