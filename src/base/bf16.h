#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// bf16 is the upper half of an f32. Files hold it in little-endian order.
namespace svnet {

/// x rounded to the nearest bf16, ties to even. NaN stays NaN.
std::uint16_t bf16_bits(float x);
/// The f32 with the same value.
float f32_of_bf16(std::uint16_t bits);

/// Two bytes for each value, rounded.
std::vector<std::byte> bf16_bytes(std::span<const float> values);
/// Requires two bytes, of any alignment, for each value.
void read_bf16(std::span<const std::byte> bytes, std::span<float> values);

}  // namespace svnet
