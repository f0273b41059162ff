#pragma once
#include <cstdint>

#include "nn/tensor.h"

namespace svnet::ops {

/// Which elements are dropped: word e of RandomStream(seed, Stream::dropout, index) decides about element e. So a mask
/// is the same for any number of threads and after training resumes.
struct DropoutKey {
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
};

/// For training: sets each element to 0 with probability `rate` (in steps of 2^-32) and multiplies the others by
/// 1 / (1 − rate). Requires at most 2^34 elements. Throws Error unless 0 <= rate < 1.
Tensor dropout(const Tensor& x, double rate, const DropoutKey& key);

}  // namespace svnet::ops
