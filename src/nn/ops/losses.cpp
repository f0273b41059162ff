#include "nn/ops/losses.h"

#include <algorithm>
#include <cmath>

#include "nn/autograd.h"
#include "nn/ops/activations.h"
#include "nn/ops/checks.h"

namespace svnet::ops {

Tensor mean_squared_error(const Tensor& prediction, const Tensor& target) {
  check_operands("mean_squared_error", {prediction, target});
  check(prediction.shape() == target.shape() && prediction.size() > 0,
        "[mean_squared_error] shapes differ or are empty: ", to_string(prediction.shape()), " and ",
        to_string(target.shape()));
  double sum = 0;
  with_dtype(prediction.dtype(), [&]<class T>() {
    for (Index i = 0; i < prediction.size(); ++i) {
      const double d = static_cast<double>(prediction.data<T>()[i]) - target.data<T>()[i];
      sum += d * d;
    }
  });
  const auto count = static_cast<double>(prediction.size());
  return autograd::record(
      Tensor::full({}, sum / count, prediction.dtype()), {prediction},
      [count, p = prediction.detached(), t = target.detached()](const Tensor& dy, autograd::Gradients& g) {
        Tensor dp = Tensor::empty(p.shape(), p.dtype());
        with_dtype(p.dtype(), [&]<class T>() {
          const T scale = static_cast<T>(2.0 / count * dy.item());
          for (Index i = 0; i < p.size(); ++i) dp.data<T>()[i] = scale * (p.data<T>()[i] - t.data<T>()[i]);
        });
        g.add(0, dp);
      });
}

Tensor softmax_cross_entropy(const Tensor& logits, const std::vector<Index>& classes) {
  check_operands("softmax_cross_entropy", {logits});
  check(logits.rank() == 2 && logits.dim(0) == static_cast<Index>(classes.size()) && !classes.empty(),
        "[softmax_cross_entropy] expects logits MxK and M classes, got ", to_string(logits.shape()), " and ",
        classes.size());
  const Index count = logits.dim(1);
  for (Index c : classes)
    check(c >= 0 && c < count, "[softmax_cross_entropy] class ", c, " is outside [0, ", count, ")");
  double sum = 0;
  with_dtype(logits.dtype(), [&]<class T>() {
    for (Index row = 0; row < logits.dim(0); ++row) {
      const T* z = logits.data<T>() + row * count;
      const double largest = *std::max_element(z, z + count);
      double total = 0;
      for (Index c = 0; c < count; ++c) total += std::exp(z[c] - largest);
      sum += std::log(total) + largest - z[classes[static_cast<std::size_t>(row)]];
    }
  });
  const auto rows = static_cast<double>(logits.dim(0));
  return autograd::record(Tensor::full({}, sum / rows, logits.dtype()), {logits},
                          [rows, classes, count, z = logits.detached()](const Tensor& dy, autograd::Gradients& g) {
                            Tensor dz = softmax(z);
                            with_dtype(z.dtype(), [&]<class T>() {
                              T* d = dz.data<T>();
                              const T scale = static_cast<T>(dy.item() / rows);
                              for (std::size_t row = 0; row < classes.size(); ++row)
                                d[static_cast<Index>(row) * count + classes[row]] -= T{1};
                              for (Index i = 0; i < dz.size(); ++i) d[i] *= scale;
                            });
                            g.add(0, dz);
                          });
}

}  // namespace svnet::ops
