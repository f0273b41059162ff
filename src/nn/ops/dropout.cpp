#include "nn/ops/dropout.h"

#include <algorithm>

#include "base/random.h"
#include "nn/autograd.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

/// y = x · mask / (1 − rate); the backward draws the mask again, so that it need not be kept.
Tensor masked(const Tensor& x, double rate, const DropoutKey& key) {
  const auto threshold = static_cast<std::uint32_t>(std::min(rate * 0x1p32, 0x1p32 - 1));
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    const T scale = static_cast<T>(1.0 / (1.0 - rate));
    thread_pool().for_chunks((x.size() + 3) / 4, 4096, [&](Index begin, Index end, int) {
      for (Index step = begin; step < end; ++step) {
        const auto words = random_words(key.seed, Stream::dropout, key.index, static_cast<std::uint32_t>(step));
        for (Index i = 4 * step; i < std::min(4 * step + 4, x.size()); ++i)
          y.data<T>()[i] = words[static_cast<std::size_t>(i - 4 * step)] < threshold ? T{0} : x.data<T>()[i] * scale;
      }
    });
  });
  return y;
}

}  // namespace

Tensor dropout(const Tensor& x, double rate, const DropoutKey& key) {
  check_operands("dropout", {x});
  check(rate >= 0 && rate < 1, "[dropout] rate must be in [0, 1), got ", rate);
  if (rate == 0) return x;
  return autograd::record(masked(x, rate, key), {x},
                          [rate, key](const Tensor& dy, autograd::Gradients& g) { g.add(0, masked(dy, rate, key)); });
}

}  // namespace svnet::ops
