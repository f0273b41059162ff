#include <cmath>

#include "base/parallel.h"
#include "nn/optim/optimizer.h"

namespace svnet {
namespace {

class Adam : public Optimizer {
 public:
  Adam(std::vector<Tensor> parameters, const AdamOptions& options)
      : parameters_(std::move(parameters)), options_(options) {
    for (const Tensor& p : parameters_) {
      first_.push_back(Tensor::zeros(p.shape(), p.dtype()));
      second_.push_back(Tensor::zeros(p.shape(), p.dtype()));
    }
  }

  void step(const autograd::GradientMap& gradients, double learning_rate) override {
    const auto t = static_cast<double>(++steps);
    const double rate = learning_rate * std::sqrt(1 - std::pow(options_.beta2, t)) / (1 - std::pow(options_.beta1, t));
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const Tensor gradient = gradients.of(parameters_[i]);
      if (gradient.defined())
        with_dtype(gradient.dtype(),
                   [&]<class T>() { update<T>(parameters_[i], gradient, first_[i], second_[i], rate); });
    }
  }

  std::vector<Tensor> state() const override {
    std::vector<Tensor> tensors = first_;
    tensors.insert(tensors.end(), second_.begin(), second_.end());
    return tensors;
  }

 private:
  template <class T>
  void update(Tensor& parameter, const Tensor& gradient, Tensor& first, Tensor& second, double rate) const {
    T *p = parameter.data<T>(), *m = first.data<T>(), *v = second.data<T>();
    const T* g = gradient.data<T>();
    // Subtracted in double: 1 − β₂ in float is off by 1e-5.
    const T follow1 = static_cast<T>(1 - options_.beta1), follow2 = static_cast<T>(1 - options_.beta2);
    const T step_size = static_cast<T>(rate), epsilon = static_cast<T>(options_.epsilon);
    Parallel::shared().for_chunks(parameter.size(), 1 << 14, [&](Index begin, Index end, int) {
      for (Index i = begin; i < end; ++i) {
        m[i] += (g[i] - m[i]) * follow1;
        v[i] += (g[i] * g[i] - v[i]) * follow2;
        p[i] -= step_size * m[i] / (std::sqrt(v[i]) + epsilon);
      }
    });
  }

  std::vector<Tensor> parameters_, first_, second_;
  AdamOptions options_;
};

}  // namespace

std::unique_ptr<Optimizer> adam(std::vector<Tensor> parameters, const AdamOptions& options) {
  return std::make_unique<Adam>(std::move(parameters), options);
}

}  // namespace svnet
