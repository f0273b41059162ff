#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>

#include <sys/mman.h>

#include "base/error.h"

namespace svnet {

/// Memory for numbers that starts on a 64-byte border, so that kernels may use whole vectors; large memory on huge
/// pages, where the system has them.
template <class T>
class AlignedArray {
  static_assert(std::is_trivial_v<T>);

 public:
  enum class Contents { zero, undefined };

  explicit AlignedArray(std::size_t size = 0, Contents contents = Contents::zero) {
    constexpr std::size_t kHugePage = std::size_t{1} << 21;
    const std::size_t bytes = size * sizeof(T), alignment = bytes < kHugePage ? 64 : kHugePage;
    const std::size_t rounded = std::max<std::size_t>((bytes + alignment - 1) / alignment, 1) * alignment;
    values_.reset(static_cast<T*>(std::aligned_alloc(alignment, rounded)));
    check(values_ != nullptr, "no memory for ", bytes >> 20, " MiB");
    if (alignment == kHugePage) (void)madvise(values_.get(), rounded, MADV_HUGEPAGE);  // a refusal changes nothing
    if (contents == Contents::zero) std::fill_n(values_.get(), rounded / sizeof(T), T{});
  }

  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](std::size_t i) { return values_.get()[i]; }
  const T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };
  std::unique_ptr<T[], Free> values_;
};

}  // namespace svnet
