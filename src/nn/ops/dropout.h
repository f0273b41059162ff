#pragma once
#include <cstdint>

#include "nn/tensor.h"

namespace svnet::ops {

/// Which numbers are dropped: element e is decided by word e of RandomStream(seed, Stream::dropout, index), so a mask
/// is the same for any number of threads and after a resume.
struct DropoutKey {
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
};

/// Training: each number is 0 with probability `rate` (in [0, 1), in multiples of 2^-32), otherwise
/// multiplied by 1 / (1 − rate). Inference needs no operation. At most 2^34 elements.
Tensor dropout(const Tensor& x, double rate, const DropoutKey& key);

}  // namespace svnet::ops
