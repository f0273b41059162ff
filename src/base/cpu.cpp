#include "base/cpu.h"

#include <algorithm>
#include <bit>
#include <fstream>

#include <hwy/targets.h>

#include "base/environment.h"
#include "base/error.h"
#include "base/text.h"

namespace svnet {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const auto at = line.find(": "); at != std::string::npos) return line.substr(at + 2);
  return "unknown";
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (auto bits = hwy::SupportedTargets() & HWY_TARGETS; bits != 0; bits &= bits - 1)
    names.emplace_back(hwy::TargetName(bits & -bits));
  return names;
}

void cap_instruction_set(const std::string& name) {
  hwy::DisableTargets(0);
  const auto known = instruction_sets();
  const auto at = std::find(known.begin(), known.end(), name);
  check(at != known.end(), "[instruction set] this machine has no '", name, "'", suggestion(name, known));
  std::int64_t better = 0;
  for (auto bits = hwy::SupportedTargets() & HWY_TARGETS; bits != 0; bits &= bits - 1) {
    const auto bit = bits & -bits;
    if (hwy::TargetName(bit) == name) break;
    better |= bit;
  }
  hwy::DisableTargets(better);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void cap_from_environment() {
  if (const std::string name = environment_variable("SVNET_MAX_ISA"); !name.empty()) cap_instruction_set(name);
}

}  // namespace svnet
