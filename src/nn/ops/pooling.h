#pragma once
#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// x (N, H, W, C) -> (N, OH, OW, C). The padding never counts: maximum and mean are taken over the pixels inside the
/// image.
Tensor max_pool2d(const Tensor& x, const WindowOptions& options);
Tensor average_pool2d(const Tensor& x, const WindowOptions& options);

/// x (N, H, W, C) -> (N, C).
Tensor global_max_pool2d(const Tensor& x);
Tensor global_average_pool2d(const Tensor& x);

}  // namespace svnet::ops
