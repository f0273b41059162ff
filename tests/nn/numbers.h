#pragma once
#include <cstdint>

#include "nn/tensor.h"

namespace svnet::test {

/// Uniform in [low, high), the same for one seed; f64 and f32 tensors of one seed differ only by rounding.
Tensor random_tensor(const Shape& shape, std::uint64_t seed, DType dtype = DType::f64, double low = -1,
                     double high = 1);

/// Shuffled values around 0 that are 0.02 apart and at least 0.01 from 0: no ties, and no kink at 0.
Tensor spaced_tensor(const Shape& shape, std::uint64_t seed, DType dtype = DType::f64);

/// |x|, the magnitude of the terms of a sum.
Tensor absolute(const Tensor& x);

/// Whether shapes, element types and all bits are equal.
bool same_bits(const Tensor& a, const Tensor& b);

/// ‖got − truth‖ / ‖truth‖ of tensors of one shape, in f64.
double relative_distance(const Tensor& got, const Tensor& truth);

/// The largest |got − truth| / (ε · magnitude), ε of got's element type; truth and magnitude are f64. Infinite if
/// shapes differ, a value is NaN, or the magnitude is 0 and the result is not exact.
double error_in_epsilons(const Tensor& got, const Tensor& truth, const Tensor& magnitude);

}  // namespace svnet::test
