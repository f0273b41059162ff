#pragma once
#include <array>
#include <cstdint>

namespace svnet {

using Sha256State = std::array<std::uint32_t, 8>;

/// Adds a block of 64 bytes to the state of a SHA-256 (FIPS 180-4), with the processor's SHA extensions if it has them.
void sha256_block(Sha256State& state, const std::uint8_t* block);
/// The same, plainly.
void sha256_block_reference(Sha256State& state, const std::uint8_t* block);

}  // namespace svnet
