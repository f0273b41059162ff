#pragma once
#include <string>
#include <vector>

#include "base/cpu.h"

namespace svnet::test {

/// Calls body(name) with the fast kernels limited to each instruction set of the machine, then removes the limit.
template <class Body>
void for_instruction_sets(Body&& body) {
  const std::vector<std::string> names = instruction_sets();
  struct Lift {
    const std::string& best;
    ~Lift() { cap_instruction_set(best); }
  } lift{names.front()};
  for (const std::string& name : names) {
    cap_instruction_set(name);
    body(name);
  }
}

}  // namespace svnet::test
