#pragma once
#include "base/enum_names.h"

namespace svnet::kernels {

/// Which kernels 3×3 convolutions of stride 1 may use. automatic: the faster ones.
enum class Convolution { automatic, direct, winograd };

}  // namespace svnet::kernels

namespace svnet {

template <>
inline constexpr auto enum_names<kernels::Convolution> =
    std::to_array<EnumName<kernels::Convolution>>({{kernels::Convolution::automatic, "automatic"},
                                                   {kernels::Convolution::direct, "direct"},
                                                   {kernels::Convolution::winograd, "winograd"}});

}  // namespace svnet
