#include "nn/layers/initializer.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"

namespace svnet {
namespace {

struct Law {
  double scale;
  bool fan_average, normal;
};

Law law(Initializer initializer) {
  switch (initializer) {
    case Initializer::glorot_uniform:
      return {1, true, false};
    case Initializer::glorot_normal:
      return {1, true, true};
    case Initializer::he_uniform:
      return {2, false, false};
    case Initializer::he_normal:
      return {2, false, true};
    case Initializer::lecun_uniform:
      return {1, false, false};
    case Initializer::lecun_normal:
      return {1, false, true};
    case Initializer::zeros:
    case Initializer::ones:
      break;  // constant
  }
  return {0, false, false};
}

double fan(const Shape& shape, bool average) {
  Index receptive = 1;
  for (std::size_t i = 0; i + 2 < shape.size(); ++i) receptive *= shape[i];
  const Index in = shape.size() >= 2 ? shape[shape.size() - 2] : element_count(shape);
  const Index out = shape.empty() ? 1 : shape.back();
  return static_cast<double>(receptive) * (average ? 0.5 * static_cast<double>(in + out) : static_cast<double>(in));
}

double truncated_normal(RandomStream& random) {
  for (;;)
    if (const double x = random.normal(); std::abs(x) <= 2) return x;
}

}  // namespace

Tensor initialised(Initializer initializer, const Shape& shape, std::uint64_t seed, std::uint32_t number, DType dtype) {
  if (initializer == Initializer::zeros) return Tensor::zeros(shape, dtype);
  if (initializer == Initializer::ones) return Tensor::full(shape, 1.0, dtype);
  const Law l = law(initializer);
  const double variance = l.scale / std::max(1.0, fan(shape, l.fan_average));
  const double limit = std::sqrt(3 * variance);
  // The standard deviation of a standard normal truncated at ±2.
  const double deviation = std::sqrt(variance) / 0.87962566103423978;
  constexpr Index kRun = 1 << 14;
  Tensor tensor = Tensor::empty(shape, dtype);
  with_dtype(dtype, [&]<class T>() {
    T* values = tensor.data<T>();
    Parallel::shared().for_chunks(tensor.size(), kRun, [&](Index begin, Index end, int) {
      RandomStream random(seed, Stream::weights,
                          std::uint64_t{number} << 32 | static_cast<std::uint64_t>(begin / kRun));
      for (Index i = begin; i < end; ++i)
        values[i] =
            static_cast<T>(l.normal ? deviation * truncated_normal(random) : limit * (2 * random.uniform() - 1));
    });
  });
  return tensor;
}

}  // namespace svnet
