#pragma once
#include <cstdint>

namespace svnet {
/// Sizes, offsets and counts: signed, so that differences are safe.
using Index = std::int64_t;
}  // namespace svnet
