#pragma once
#include <cstdint>
#include <vector>

#include "base/index.h"

// The two passes of a resampling filter over 8-bit RGB pixels, in fixed point: a target value is
// (Σ weight · source + 2^21) >> 22, at least 0 and at most 255. All instruction sets give the same bits.
namespace svnet {

inline constexpr int kFilterBits = 22;  // 32, less 8 for the pixel and 2 for the sum of weights

/// A filter along one axis: target[i] = Σ weights[i * taps + t] · source[starts[i] + t] over t < counts[i]. Weights
/// are in units of 2^-22, not negative, and add up to about 1.
struct ResizeFilter {
  Index taps = 0;
  std::vector<Index> starts{}, counts{};
  std::vector<std::int32_t> weights{};
};

/// What filter_width keeps between calls.
struct WidthBuffers {
  std::vector<std::int16_t> weights{};   // in the layout of the vectors
  std::vector<std::uint8_t> last_row{};  // with bytes after its end that can be read
};

/// in (rows, from, 3) -> out (rows, to, 3); the filter has `to` targets.
void filter_width(const ResizeFilter&, const std::uint8_t* in, Index rows, Index from, Index to, std::uint8_t* out,
                  WidthBuffers& buffers);
/// in (from, row_size) -> out (to, row_size); the filter has `to` targets.
void filter_height(const ResizeFilter&, const std::uint8_t* in, Index row_size, Index to, std::uint8_t* out);

/// The same, plainly.
void filter_width_reference(const ResizeFilter&, const std::uint8_t* in, Index rows, Index from, Index to,
                            std::uint8_t* out);
void filter_height_reference(const ResizeFilter&, const std::uint8_t* in, Index row_size, Index to, std::uint8_t* out);

}  // namespace svnet
