#pragma once
#include <algorithm>
#include <cstdint>

namespace svnet::io::hdf5 {

/// The largest memory that a dataset or attribute may need.
inline constexpr std::uint64_t kLargestBytes = std::uint64_t{1} << 36;

/// The longest string.
inline constexpr std::uint64_t kLargestText = std::uint64_t{1} << 26;

/// Deflate compresses at most 1032 to 1 (zlib's technical details).
inline constexpr std::uint64_t kLargestCompression = 1040;

/// The most bytes that a dataset of a file of this size may be decoded to. Weights and features compress 1 to 8 times;
/// what compresses more, and is not small, was made to fill memory.
inline std::uint64_t largest_decoded(std::uint64_t file_size) {
  constexpr std::uint64_t kAlways = std::uint64_t{16} << 20, kTimes = 16;
  return std::max(kAlways, std::min(kTimes * std::min(file_size, kLargestBytes), kLargestBytes));
}

}  // namespace svnet::io::hdf5
