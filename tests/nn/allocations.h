#pragma once
#include <cstddef>

namespace svnet::test {

/// Bytes of aligned storage (tensors' numbers) that are in use now, and the most since reset_peak().
std::size_t bytes_in_use();
std::size_t peak_bytes();
void reset_peak();

}  // namespace svnet::test
