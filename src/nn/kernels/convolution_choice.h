#pragma once

namespace svnet::kernels {

/// Which kernels 3×3 convolutions of stride 1 may use.
enum class Convolution { automatic, direct, winograd };

/// What SVNET_CONVOLUTION=direct|winograd forces, for testing; automatic without it. Throws Error for another word.
Convolution convolution_from_environment();

}  // namespace svnet::kernels
