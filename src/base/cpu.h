#pragma once
#include <string>
#include <vector>

namespace svnet {

/// The name of the processor, as the operating system gives it.
std::string cpu_name();

/// The instruction sets that the fast kernels may use on this machine, best first (Highway's names: AVX3, AVX2, SSE4,
/// …).
std::vector<std::string> instruction_sets();

/// Keeps svnet's own kernels from using instruction sets better than `name`. OpenBLAS is not affected. Throws Error for
/// an unknown name or one that this machine lacks.
void cap_instruction_set(const std::string& name);
/// The same with SVNET_MAX_ISA, if it is set. Every program calls this before anything else.
void cap_from_environment();

}  // namespace svnet
