#pragma once
#include <cstdint>

#include "nn/tensor.h"

namespace svnet::test {

/// Uniform in [low, high), the same for one seed; f64 and f32 tensors of one seed differ by rounding alone.
Tensor random_tensor(const Shape& shape, std::uint64_t seed, DType dtype = DType::f64, double low = -1,
                     double high = 1);

/// A shuffle of numbers 0.02 apart around 0, none nearer to 0 than 0.01: no ties, and no kink at 0.
Tensor spaced_tensor(const Shape& shape, std::uint64_t seed, DType dtype = DType::f64);

/// |x|, to measure the magnitude of what is summed.
Tensor absolute(const Tensor& x);

/// Whether shapes, element types and all bits are equal.
bool same_bits(const Tensor& a, const Tensor& b);

/// ‖got − truth‖ / ‖truth‖ of tensors of one shape, in f64.
double relative_distance(const Tensor& got, const Tensor& truth);

/// The largest |got − truth| / (ε · magnitude), ε of got's element type; truth and magnitude are f64. Infinite where
/// shapes differ, a number is NaN, or a magnitude of 0 does not go with an exact result.
double error_in_epsilons(const Tensor& got, const Tensor& truth, const Tensor& magnitude);

}  // namespace svnet::test
