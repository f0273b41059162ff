#pragma once
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace svnet::kernels {

/// Which of two words an environment variable holds: `first`, `second`, or neither where it is unset or empty, which is
/// `unset`. Throws Error for another word.
template <class T>
T environment_word(const char* variable, const char* first, T if_first, const char* second, T if_second, T unset) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return unset;
  const std::string word = text;
  check(word == first || word == second, "[", variable, "] '", word, "' is neither ", first, " nor ", second);
  return word == first ? if_first : if_second;
}

}  // namespace svnet::kernels
