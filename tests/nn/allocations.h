#pragma once
#include <cstddef>

namespace svnet::test {

/// Bytes of tensor storage in use now, and the maximum since reset_peak().
std::size_t bytes_in_use();
std::size_t peak_bytes();
void reset_peak();

}  // namespace svnet::test
