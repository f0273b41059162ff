#pragma once
#include "base/enum_names.h"

namespace svnet {

/// How the moving statistics are updated from those of a batch.
/// keras: moving = momentum · moving + (1 − momentum) · batch, with the biased variance (momentum near 1).
/// pytorch: moving = (1 − momentum) · moving + momentum · batch, with the unbiased variance (momentum near 0).
enum class MomentumConvention { keras, pytorch };

constexpr auto enum_table(MomentumConvention) {
  return std::to_array<EnumName<MomentumConvention>>(
      {{MomentumConvention::keras, "keras"}, {MomentumConvention::pytorch, "pytorch"}});
}

struct BatchNormOptions {
  double momentum = 0.99;
  double epsilon = 1e-3;
  MomentumConvention convention = MomentumConvention::keras;
};

}  // namespace svnet
