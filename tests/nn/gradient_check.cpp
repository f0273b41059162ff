#include "nn/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nn/autograd.h"
#include "nn/numbers.h"

namespace svnet::test {
namespace {

double weighted_sum(const Tensor& y, const Tensor& w) {
  long double sum = 0;
  for (Index i = 0; i < y.size(); ++i) sum += static_cast<long double>(y.data<double>()[i]) * w.data<double>()[i];
  return static_cast<double>(sum);
}

/// The tape's gradients of the wanted inputs; empty tensors for the others.
std::vector<Tensor> analytic(const Function& function, const std::vector<Tensor>& inputs, const Tensor& w,
                             const std::vector<bool>& wanted) {
  std::vector<Tensor> leaves;
  for (std::size_t i = 0; i < inputs.size(); ++i) leaves.push_back(wanted[i] ? inputs[i].as_parameter() : inputs[i]);
  autograd::GradientMap gradients;
  autograd::backward(function(leaves), gradients, w);
  std::vector<Tensor> result;
  for (std::size_t i = 0; i < inputs.size(); ++i) result.push_back(wanted[i] ? gradients.of(leaves[i]) : Tensor{});
  return result;
}

Tensor numeric(const Function& function, std::vector<Tensor> inputs, std::size_t which, const Tensor& w, double step) {
  const Tensor original = inputs[which];
  Tensor gradient = Tensor::empty(original.shape(), DType::f64);
  for (Index i = 0; i < original.size(); ++i) {
    const auto at = [&](double offset) {
      inputs[which] = original.clone();
      inputs[which].data<double>()[i] += offset;
      return weighted_sum(function(inputs), w);
    };
    gradient.data<double>()[i] = (at(step) - at(-step)) / (2 * step);
  }
  return gradient;
}

double relative_error(const Tensor& a, const Tensor& n) {
  double difference = 0, size = 0;
  for (Index i = 0; i < n.size(); ++i) {
    const double d = std::abs(a.data<double>()[i] - n.data<double>()[i]);
    difference = d <= difference ? difference : d;  // keeps NaN
    size = std::max(size, std::abs(n.data<double>()[i]));
  }
  return size > 1e-3 && !std::isnan(difference) ? difference / size : std::numeric_limits<double>::infinity();
}

}  // namespace

GradientReport check_gradients(const Function& function, const std::vector<Tensor>& inputs, double step) {
  const Tensor w = random_tensor(function(inputs).shape(), 77, DType::f64, 0.5, 1.5);
  const auto together = analytic(function, inputs, w, std::vector<bool>(inputs.size(), true));
  GradientReport report;
  const auto note = [&](std::size_t input, double error, const char* what) {
    if (error <= report.relative_error) return;
    report = {error, "input " + std::to_string(input) + " " + what};
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!together[i].defined() || together[i].shape() != inputs[i].shape()) {
      note(i, kInfinity, "has no gradient, or one of another shape");
      continue;
    }
    note(i, relative_error(together[i], numeric(function, inputs, i, w, step)), "differs from central differences");
    std::vector<bool> alone(inputs.size(), false);
    alone[i] = true;
    if (!same_bits(analytic(function, inputs, w, alone)[i], together[i]))
      note(i, kInfinity, "has another gradient when the other inputs want none");
  }
  return report;
}

}  // namespace svnet::test
