#pragma once
#include "base/index.h"

namespace svnet::kernels {

/// The block of a streamed weight matrix that is laid out at once: 64 KiB.
inline constexpr Index kStreamedDepth = 128, kStreamedColumns = 128;

}  // namespace svnet::kernels
