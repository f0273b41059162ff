// Counts the storage of tensors by replacing the aligned operator new and delete, which only tensors use in the tests.
#include "nn/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> in_use{0}, peak{0};

/// The size is stored in front of the storage, one alignment before it.
void* allocate(std::size_t bytes, std::size_t alignment) {
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  auto* start = static_cast<char*>(std::aligned_alloc(alignment, rounded + alignment));
  if (start == nullptr) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(start) = bytes;
  const std::size_t now = in_use += bytes;
  for (std::size_t most = peak; most < now && !peak.compare_exchange_weak(most, now);) {
  }
  return start + alignment;
}

void release(void* storage, std::size_t alignment) {
  if (storage == nullptr) return;
  char* start = static_cast<char*>(storage) - alignment;
  in_use -= *reinterpret_cast<std::size_t*>(start);
  std::free(start);
}

}  // namespace

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* p, std::align_val_t alignment) noexcept { release(p, static_cast<std::size_t>(alignment)); }
void operator delete(void* p, std::size_t, std::align_val_t alignment) noexcept {
  release(p, static_cast<std::size_t>(alignment));
}

namespace svnet::test {

std::size_t bytes_in_use() { return in_use; }
std::size_t peak_bytes() { return peak; }
void reset_peak() { peak = in_use.load(); }

}  // namespace svnet::test
