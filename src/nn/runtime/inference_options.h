#pragma once
#include <memory>
#include <string>

#include "nn/kernels/convolution_choice.h"
#include "nn/kernels/precision.h"
#include "nn/runtime/activation_ranges.h"

namespace svnet {

/// How networks are computed. The number of threads is that of Parallel::shared().
struct InferenceOptions {
  kernels::Convolution convolution = kernels::Convolution::automatic;
  kernels::Precision precision = kernels::Precision::f32;
  /// Large dense layers keep their weights in int8 (nn/kernels/int8), instead of `precision`: for models whose weights
  /// are stored so, and whose values are therefore not changed.
  bool int8_dense = false;
  /// Required if the precision is int8 and the network has convolutions. Dense layers stay f32.
  std::shared_ptr<const ActivationRanges> ranges{};
  /// For Inference::observe: a step for every product.
  bool observable = false;
};

/// What SVNET_CONVOLUTION and SVNET_PRECISION ask for; the defaults if they are unset or empty. A `precision` that is
/// not empty, f32, bf16 or int8, is taken instead of SVNET_PRECISION. Throws Error for other words, and if the machine
/// has no products of that precision. For the edges of programs: everything below them takes InferenceOptions.
InferenceOptions inference_options_from_environment(const std::string& precision = "");

}  // namespace svnet
