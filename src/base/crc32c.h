#pragma once
#include <cstdint>
#include <string_view>

namespace svnet {

/// CRC-32C (Castagnoli), RFC 3720 section 12.1. About 2 GB/s.
std::uint32_t crc32c(std::string_view bytes);

}  // namespace svnet
