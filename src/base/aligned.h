#pragma once
#include <cstdlib>
#include <memory>
#include <new>

#include "base/index.h"

namespace svnet {

/// A cache line, and the widest vector of any machine.
inline constexpr std::size_t kAlignment = 64;

struct FreeAligned {
  void operator()(float* p) const { std::free(p); }
};
using AlignedFloats = std::unique_ptr<float[], FreeAligned>;

/// Memory for `count` numbers, aligned to 64 bytes, with room for one more vector, so that a kernel may read past the
/// end. Not initialised.
inline AlignedFloats aligned_floats(Index count) {
  const std::size_t bytes = (static_cast<std::size_t>(count) * sizeof(float) / kAlignment + 2) * kAlignment;
  auto* p = static_cast<float*>(std::aligned_alloc(kAlignment, bytes));
  if (p == nullptr) throw std::bad_alloc();
  return AlignedFloats(p);
}

}  // namespace svnet
