#include "train/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace svnet::train {
namespace {

/// The largest absolute value; infinity if an element is not finite.
float largest(const Tensor& x) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<float> found(static_cast<std::size_t>(Parallel::shared().threads()), 0.0f);
  const auto elements = x.defined() ? x.values<float>() : std::span<const float>{};
  Parallel::shared().for_chunks(static_cast<Index>(elements.size()), 1 << 16, [&](Index begin, Index end, int worker) {
    float most = 0;
    bool finite = true;
    for (Index i = begin; i < end; ++i) {
      const float value = std::abs(elements[static_cast<std::size_t>(i)]);
      finite = finite && value < kInfinity;  // NaN is not less
      most = value > most ? value : most;
    }
    float& here = found[static_cast<std::size_t>(worker)];
    here = std::max(here, finite ? most : kInfinity);
  });
  return *std::max_element(found.begin(), found.end());
}

}  // namespace

bool is_finite(const Tensor& tensor) { return std::isfinite(largest(tensor)); }

bool has_finite_gradient(const autograd::GradientMap& gradients, const Tensor& parameter) {
  if (const auto* product = gradients.product_of(parameter))
    return static_cast<double>(largest(product->x)) * largest(product->dy) * static_cast<double>(product->x.dim(0)) <
           std::numeric_limits<float>::max();
  return is_finite(gradients.of(parameter));
}

}  // namespace svnet::train
