#pragma once
#include "base/enum_names.h"

namespace svnet::kernels {

/// Which kernels 3×3 convolutions of stride 1 may use. automatic: the faster ones.
enum class Convolution { automatic, direct, winograd };

constexpr auto enum_table(Convolution) {
  return std::to_array<EnumName<Convolution>>(
      {{Convolution::automatic, "automatic"}, {Convolution::direct, "direct"}, {Convolution::winograd, "winograd"}});
}

}  // namespace svnet::kernels
