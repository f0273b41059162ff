#pragma once
#include <functional>

#include "serve/http_exchange.h"
#include "serve/limits.h"
#include "serve/listener.h"

namespace svnet::serve {

/// Takes connections and answers one request on each, until `check_interrupt` throws, whose exception it passes on.
/// `check_interrupt` is called at least five times a second. Then no more connections are taken, connections whose
/// request has not come are closed, and requests that are being answered are finished. `answer` must be thread-safe.
void serve(const Listener&, const Limits&, const Answer& answer, const std::function<void()>& check_interrupt);

}  // namespace svnet::serve
