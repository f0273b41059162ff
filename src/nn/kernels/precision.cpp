#include "nn/kernels/precision.h"

#include <hwy/targets.h>

#include "base/cpu.h"
#include "base/error.h"
#include "nn/kernels/packed/bf16_tile.h"

namespace svnet::kernels {

void check_available(Precision precision) {
  if (precision != Precision::bf16) return;
  check(machine_has_bf16(), "[precision] bf16 needs a processor with AVX512-BF16, this one (", cpu_name(),
        ") lacks it; choose f32");
  check((hwy::SupportedTargets() & HWY_AVX3) != 0, "[precision] bf16 needs AVX-512, but kernels are capped at ",
        instruction_sets().front(), "; choose f32, or leave SVNET_MAX_ISA unset");
}

}  // namespace svnet::kernels
