#include "nn/kernels/precision.h"

#include <cstdlib>
#include <string>

#include <hwy/targets.h>

#include "base/cpu.h"
#include "base/error.h"
#include "nn/kernels/packed/bf16_tile.h"

namespace svnet::kernels {

Precision precision_from_environment() {
  const char* text = std::getenv("SVNET_PRECISION");
  if (text == nullptr || *text == '\0') return Precision::f32;
  const std::string word = text;
  check(word == "f32" || word == "bf16", "[SVNET_PRECISION] '", word, "' is neither f32 nor bf16");
  return word == "f32" ? Precision::f32 : Precision::bf16;
}

void check_available(Precision precision) {
  if (precision == Precision::f32) return;
  check(machine_has_bf16(), "[precision] bf16 needs a processor with AVX512-BF16, this one (", cpu_name(),
        ") lacks it; choose f32");
  check((hwy::SupportedTargets() & HWY_AVX3) != 0, "[precision] bf16 needs AVX-512, but kernels are capped at ",
        instruction_sets().front(), "; choose f32, or leave SVNET_MAX_ISA unset");
}

}  // namespace svnet::kernels
