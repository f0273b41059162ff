#pragma once
#include <cmath>

namespace svnet::kernels {

/// Batch norm of one channel with given statistics: y = (x − mean) · scale + beta = x · scale + shift(), in double.
struct ChannelNorm {
  double mean, scale, beta;

  double operator()(double x) const { return (x - mean) * scale + beta; }
  double shift() const { return beta - mean * scale; }
};

/// scale = gamma / √(variance + ε).
inline ChannelNorm channel_norm(double gamma, double beta, double mean, double variance, double epsilon) {
  return {.mean = mean, .scale = gamma / std::sqrt(variance + epsilon), .beta = beta};
}

}  // namespace svnet::kernels
