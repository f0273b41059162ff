#include "nn/numbers.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "base/random.h"

namespace svnet::test {

Tensor random_tensor(const Shape& shape, std::uint64_t seed, DType dtype, double low, double high) {
  Tensor x = Tensor::empty(shape, DType::f64);
  RandomStream random(seed, Stream::collection);
  for (Index i = 0; i < x.size(); ++i) x.data<double>()[i] = low + (high - low) * random.uniform();
  return x.to(dtype);
}

Tensor spaced_tensor(const Shape& shape, std::uint64_t seed, DType dtype) {
  Tensor x = Tensor::empty(shape, DType::f64);
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  RandomStream random(seed, Stream::collection);
  draw_without_replacement(random, order.data(), x.size(), x.size());
  for (Index i = 0; i < x.size(); ++i)
    x.data<double>()[i] = 0.02 * static_cast<double>(order[static_cast<std::size_t>(i)] - x.size() / 2) + 0.01;
  return x.to(dtype);
}

Tensor absolute(const Tensor& x) {
  Tensor y = x.clone();
  with_dtype(x.dtype(), [&]<class T>() {
    for (Index i = 0; i < y.size(); ++i) y.data<T>()[i] = std::abs(y.data<T>()[i]);
  });
  return y;
}

bool same_bits(const Tensor& a, const Tensor& b) {
  if (!a.defined() || !b.defined() || a.shape() != b.shape() || a.dtype() != b.dtype()) return false;
  return with_dtype(a.dtype(), [&]<class T>() {
    return std::memcmp(a.data<T>(), b.data<T>(), static_cast<std::size_t>(a.size()) * sizeof(T)) == 0;
  });
}

double relative_distance(const Tensor& got, const Tensor& truth) {
  check(got.shape() == truth.shape(), "[relative_distance] ", to_string(got.shape()), " and ",
        to_string(truth.shape()));
  const Tensor found = got.to(DType::f64), expected = truth.to(DType::f64);
  double difference = 0, norm = 0;
  for (Index i = 0; i < expected.size(); ++i) {
    const double t = expected.data<double>()[i], d = found.data<double>()[i] - t;
    difference += d * d;
    norm += t * t;
  }
  return std::sqrt(difference / norm);
}

double error_in_epsilons(const Tensor& got, const Tensor& truth, const Tensor& magnitude) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (got.shape() != truth.shape() || got.shape() != magnitude.shape()) return kInfinity;
  double largest = 0;
  with_dtype(got.dtype(), [&]<class T>() {
    for (Index i = 0; i < got.size(); ++i) {
      const double error = std::abs(static_cast<double>(got.data<T>()[i]) - truth.data<double>()[i]);
      if (error == 0) continue;
      const double ratio = error / (std::numeric_limits<T>::epsilon() * magnitude.data<double>()[i]);
      largest = ratio <= largest ? largest : std::isnan(ratio) ? kInfinity : ratio;
    }
  });
  return largest;
}

}  // namespace svnet::test
