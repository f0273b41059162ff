#pragma once
#include <string>

#include "svnet/svnet.h"

namespace svnet {

/// Whether there is a callback, so that a caller need not make a line that nobody reads.
bool is_logging() noexcept;

/// Hands a line to the callback, if there is one. Calls from within the callback are dropped: they would wait for
/// themselves.
void log_line(svnet_log_level level, const std::string& line);

}  // namespace svnet
