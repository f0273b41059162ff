#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "base/aligned.h"
#include "base/error.h"

namespace svnet::semantics {

/// An array from aligned_memory: 64-byte aligned, with one vector of padding, so that kernels may read whole vectors.
template <class T>
class AlignedArray {
  static_assert(std::is_trivial_v<T>);

 public:
  enum class Contents { zero, undefined };

  explicit AlignedArray(std::size_t size = 0, Contents contents = Contents::zero) {
    const std::size_t bytes = size * sizeof(T);
    values_.reset(static_cast<T*>(aligned_memory(bytes)));
    if (values_ == nullptr) throw NoMemory(bytes);
    // The padding too, because kernels may read it.
    if (contents == Contents::zero) std::fill_n(values_.get(), size + kAlignment / sizeof(T), T{});
  }

  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  std::unique_ptr<T[], FreeAligned> values_;
};

}  // namespace svnet::semantics
