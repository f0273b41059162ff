#pragma once
#include <cstdint>

#include "base/index.h"

namespace svnet::kmeans {

// Loops over the points of a problem. Arrays are 64-byte aligned and padded to whole vectors of 16; what stands in the
// paddings must be finite, and 0 in `closest`. Sums are in double.

/// The sum over the points of min(closest, row).
double potential(const float* closest, const float* row, Index n);

/// closest = min(closest, row)
void take_minimum(const float* row, Index n, float* closest);

/// sum += factor · row, for factors 1 and -1.
void add_row(const float* row, double factor, Index n, double* sum);

/// Of k centres, centre c at the squared distance max(0, sum[c · stride + i] · scale[c] - half_spread[c]) from point i,
/// the nearest to each point: nearest[i], and its number label[i]; of equally near ones the first. A scale of 0 takes a
/// centre out.
void assign(const double* sum, Index stride, const double* scale, const double* half_spread, Index k, Index n,
            double* nearest, double* label);

}  // namespace svnet::kmeans
