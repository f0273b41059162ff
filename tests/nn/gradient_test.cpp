#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "nn/autograd.h"
#include "nn/gradient_cases.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

TEST_CASE("gradients equal central differences to 1e-6") {
  const auto cases = gradient_cases();
  for (std::size_t i = 0; i < cases.size();) {
    const std::string& op = cases[i].op;
    double largest = 0;
    int count = 0;
    for (; i < cases.size() && cases[i].op == op; ++i, ++count) {
      const auto report = check_gradients(cases[i].function, cases[i].inputs);
      INFO(op << ", " << cases[i].what << ": " << report.worst);
      CHECK(report.relative_error < 1e-6);
      largest = std::max(largest, report.relative_error);
    }
    std::printf("%-22s %.1e  (%d case%s)\n", op.c_str(), largest, count, count == 1 ? "" : "s");
  }
}

namespace {

/// The gradients of Σ y·w, w fixed, with respect to each input.
std::vector<Tensor> gradients(const Function& function, const std::vector<Tensor>& inputs) {
  std::vector<Tensor> leaves;
  for (const Tensor& input : inputs) leaves.push_back(input.as_parameter());
  const Tensor y = function(leaves);
  autograd::GradientMap map;
  autograd::backward(y, map, random_tensor(y.shape(), 99, y.dtype()));
  std::vector<Tensor> found;
  for (const Tensor& leaf : leaves) found.push_back(map.of(leaf));
  return found;
}

}  // namespace

TEST_CASE("gradients in f32 equal those in f64 to 1e-5, relative L2") {
  double largest = 0;
  for (const auto& c : gradient_cases()) {
    // Two rows of equal distance from their mean: the gradient of x cancels.
    if (c.op == "batch_norm_training" && c.inputs[0].dim(0) == 2) continue;
    std::vector<Tensor> narrow, wide;
    for (const Tensor& input : c.inputs) {
      narrow.push_back(input.to(DType::f32));
      wide.push_back(narrow.back().to(DType::f64));
    }
    const auto found = gradients(c.function, narrow), truth = gradients(c.function, wide);
    for (std::size_t i = 0; i < found.size(); ++i) {
      INFO(c.op << ", " << c.what << ", input " << i);
      const double distance = relative_distance(found[i], truth[i]);
      CHECK(distance <= 1e-5);
      largest = std::max(largest, distance);
    }
  }
  std::printf("f32 against f64: %.1e\n", largest);
}

namespace {

/// x² elementwise with the gradient `slope`·x·dy, which is correct only for slope 2.
Tensor square(const Tensor& x, double slope) {
  const auto times = [](const Tensor& a, const Tensor& b, double factor) {
    Tensor y = Tensor::empty(a.shape(), DType::f64);
    for (Index i = 0; i < y.size(); ++i) y.data<double>()[i] = factor * a.data<double>()[i] * b.data<double>()[i];
    return y;
  };
  return autograd::record(times(x, x, 1), {x}, [=, x = x.detached()](const Tensor& dy, autograd::Gradients& g) {
    if (slope != 0) g.add(0, times(x, dy, slope));
  });
}

double error_of(const Function& function, const std::vector<Tensor>& inputs) {
  return check_gradients(function, inputs).relative_error;
}

}  // namespace

TEST_CASE("the gradient checker catches wrong closures") {
  const Tensor x = random_tensor({3, 4}, 1);
  CHECK(error_of([](const auto& in) { return square(in[0], 2); }, {x}) < 1e-9);
  CHECK(error_of([](const auto& in) { return square(in[0], 2.00001); }, {x}) > 1e-6);
  CHECK(error_of([](const auto& in) { return square(in[0], 0); }, {x}) > 1);  // gives no gradient at all

  SECTION("a gradient that arrives at the wrong input") {
    const auto swapped = [](const std::vector<Tensor>& in) {
      Tensor y = in[0].clone();
      for (Index i = 0; i < y.size(); ++i) y.data<double>()[i] -= in[1].data<double>()[i];
      return autograd::record(y, in, [](const Tensor& dy, autograd::Gradients& g) {
        Tensor minus = dy.clone();
        for (Index i = 0; i < minus.size(); ++i) minus.data<double>()[i] *= -1;
        g.add(0, minus);
        g.add(1, dy);
      });
    };
    CHECK(error_of(swapped, {x, random_tensor({3, 4}, 2)}) > 1);
  }
  SECTION("a gradient that is wrong where the other input wants none") {
    const auto careless = [](const std::vector<Tensor>& in) {
      Tensor y = in[0].clone();
      autograd::accumulate(y, in[1]);
      return autograd::record(y, in, [](const Tensor& dy, autograd::Gradients& g) {
        g.add(0, g.wants(1) ? dy : Tensor::zeros(dy.shape(), DType::f64));
        g.add(1, dy);
      });
    };
    const auto report = check_gradients(careless, {x, random_tensor({3, 4}, 2)});
    CHECK(report.worst == "input 0 has another gradient when the other inputs want none");
  }
}
