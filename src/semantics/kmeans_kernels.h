#pragma once
#include <cstdint>

#include "base/index.h"

namespace svnet::semantics::kmeans {

// Loops over the n points of a problem. Requires: arrays are 64-byte aligned and padded to a multiple of 16 elements;
// the padding is finite, and 0 in `closest`. Sums are in double.

/// Returns the sum of min(closest[i], row[i]).
double potential(const float* closest, const float* row, Index n);

/// closest = min(closest, row)
void take_minimum(const float* row, Index n, float* closest);

/// sum += factor · row. Requires: factor is 1 or -1.
void add_row(const float* row, double factor, Index n, double* sum);

/// Finds the nearest of k centres for each point. The squared distance of centre c to point i is
/// max(0, sum[c · stride + i] · scale[c] - half_spread[c]). Sets nearest[i] to the smallest distance and label[i] to
/// its centre, the first one in a tie. Centres with scale 0 are ignored.
void assign(const double* sum, Index stride, const double* scale, const double* half_spread, Index k, Index n,
            double* nearest, double* label);

}  // namespace svnet::semantics::kmeans
