#include "command/openblas_cap.h"

#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace svnet {
namespace {

/// The best kernels of OpenBLAS within an instruction set of base/cpu.h; nullptr: no cap.
const char* core_within(std::string_view instruction_set) {
  if (instruction_set == "AVX2") return "Haswell";
  if (instruction_set == "SSE4") return "Nehalem";
  if (instruction_set == "SSSE3") return "Core2";
  if (instruction_set == "SSE2" || instruction_set == "SCALAR") return "Prescott";  // the lowest that OpenBLAS has
  return nullptr;
}

}  // namespace

void cap_openblas_from_environment(char** argv) {
  const char* cap = std::getenv("SVNET_MAX_ISA");
  const char* core = cap != nullptr ? core_within(cap) : nullptr;
  if (core == nullptr || std::getenv("OPENBLAS_CORETYPE") != nullptr) return;
  ::setenv("OPENBLAS_CORETYPE", core, 1);
  ::execv("/proc/self/exe", argv);  // returns only if it fails; then the program runs without the cap
}

}  // namespace svnet
