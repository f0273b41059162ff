#pragma once
#include "nn/batch_norm_options.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// Per channel of the last axis: (x − mean) / √(variance + ε) · gamma + beta with the batch's mean and biased variance.
/// x is (M, C) or (N, H, W, C); gamma, beta and the moving statistics are (C). Updates the moving statistics in place.
/// Throws Error if a channel has fewer than two values: one has no variance.
Tensor batch_norm_training(const Tensor& x, const Tensor& gamma, const Tensor& beta, Tensor& moving_mean,
                           Tensor& moving_variance, const BatchNormOptions& options);

/// The same with the given statistics. x, gamma and beta receive gradients, the statistics do not.
Tensor batch_norm_inference(const Tensor& x, const Tensor& gamma, const Tensor& beta, const Tensor& mean,
                            const Tensor& variance, double epsilon);

}  // namespace svnet::ops
