#include "nn/kernels/adam/adam.h"

#include <cmath>

#include "base/parallel.h"
#include "nn/kernels/adam/adam_product.h"
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
    const kernels::AdamStep step{
        .rate = learning_rate * std::sqrt(1 - std::pow(options_.beta2, t)) / (1 - std::pow(options_.beta1, t)),
        .beta1 = options_.beta1,
        .beta2 = options_.beta2,
        .epsilon = options_.epsilon};
    const double kept = 1 - learning_rate * options_.weight_decay;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (const auto* p = gradients.product_of(parameters_[i]); p != nullptr && p->x.dtype() == DType::f32) {
        decay(parameters_[i], kept);
        kernels::adam_product(Parallel::shared(), step, {p->x.dim(0), p->x.dim(1), p->dy.dim(1)}, p->x.data<float>(),
                              p->dy.data<float>(), parameters_[i].data<float>(), first_[i].data<float>(),
                              second_[i].data<float>());
        continue;
      }
      const Tensor gradient = gradients.of(parameters_[i]);
      if (!gradient.defined()) continue;
      decay(parameters_[i], kept);
      with_dtype(gradient.dtype(), [&]<class T>() {
        kernels::adam(Parallel::shared(), step, gradient.size(), gradient.data<T>(), parameters_[i].data<T>(),
                      first_[i].data<T>(), second_[i].data<T>());
      });
    }
  }

  std::vector<Tensor> state() const override {
    std::vector<Tensor> tensors = first_;
    tensors.insert(tensors.end(), second_.begin(), second_.end());
    return tensors;
  }

 private:
  /// Weight decay, of tensors of two axes or more.
  static void decay(Tensor& parameter, double kept) {
    if (kept == 1 || parameter.rank() < 2) return;
    with_dtype(parameter.dtype(), [&]<class T>() {
      for (Index i = 0; i < parameter.size(); ++i) parameter.data<T>()[i] *= static_cast<T>(kept);
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
