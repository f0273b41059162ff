#pragma once
#include <cstdint>
#include <vector>

#include "base/index.h"
#include "base/parallel.h"

namespace svnet::train {

/// Coordinates of a row x of `inputs` values: (x - mean)ᵀ directions.
struct PrincipalComponents {
  Index inputs = 0;
  Index components = 0;
  std::vector<double> mean{};        ///< (inputs)
  std::vector<double> directions{};  ///< (inputs, components), orthogonal, of one length
  std::vector<double> variances{};   ///< (components) of the rows along unit directions, descending
};

/// The `most` principal components of rows (rows, inputs); fewer if the rows do not vary in as many directions. The
/// length of the directions is such that the coordinates of the rows have the mean square 1 over rows and components;
/// the largest entry of each direction is positive.
/// Randomised subspace iteration in f64 (Halko, Martinsson and Tropp, "Finding structure with randomness", 2011,
/// algorithms 4.4 and 5.3): exact up to rounding if `most` + 50 directions are all there are. Otherwise the last
/// components approximate the true ones, and lose little of their variance.
/// Has the same bits for any number of threads. Throws Error unless there is a row and a value in it varies.
PrincipalComponents principal_components(const std::vector<float>& rows, Index inputs, Index most, std::uint64_t seed,
                                         Parallel& parallel);

}  // namespace svnet::train
