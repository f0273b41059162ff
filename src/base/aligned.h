#pragma once
#include <cstdint>
#include <cstdlib>
#include <memory>

#include <sys/mman.h>

#include "base/error.h"
#include "base/index.h"

namespace svnet {

/// A cache line, and the widest vector of any machine.
inline constexpr std::size_t kAlignment = 64;

/// Asks for huge pages if the memory is large: weights and matrices that are read in large steps miss the TLB less.
inline void advise_huge_pages(void* memory, std::size_t bytes) {
  constexpr std::size_t kLarge = std::size_t{4} << 20, kPage = 4096;
  if (bytes < kLarge) return;
  const auto first = (reinterpret_cast<std::uintptr_t>(memory) + kPage - 1) / kPage * kPage;
  const auto last = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
  ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);  // a wish: refusal changes nothing
}

/// Memory that starts on a 64-byte boundary and has room for one more vector at the end. Large memory is on huge pages
/// if the system has them. Not initialised. Returns nullptr if there is no memory. Freed by std::free.
inline void* aligned_memory(std::size_t bytes) {
  const std::size_t rounded = (bytes / kAlignment + 2) * kAlignment;
  void* memory = std::aligned_alloc(kAlignment, rounded);
  if (memory != nullptr) advise_huge_pages(memory, rounded);
  return memory;
}

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};
using AlignedFloats = std::unique_ptr<float[], FreeAligned>;

/// Memory for `count` floats. A kernel may read one vector past the end. Not initialised.
inline AlignedFloats aligned_floats(Index count) {
  const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(float);
  auto* p = static_cast<float*>(aligned_memory(bytes));
  if (p == nullptr) throw NoMemory(bytes);
  return AlignedFloats(p);
}

}  // namespace svnet
