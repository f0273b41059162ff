#include "base/parallel.h"
#include "nn/optim/optimizer.h"

namespace svnet {
namespace {

class Sgd : public Optimizer {
 public:
  Sgd(std::vector<Tensor> parameters, const SgdOptions& options)
      : parameters_(std::move(parameters)), options_(options) {
    for (const Tensor& p : parameters_) velocity_.push_back(Tensor::zeros(p.shape(), p.dtype()));
  }

  void step(const autograd::GradientMap& gradients, double learning_rate) override {
    ++steps;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const Tensor gradient = gradients.of(parameters_[i]);
      if (!gradient.defined()) continue;
      with_dtype(gradient.dtype(), [&]<class T>() {
        T *p = parameters_[i].data<T>(), *u = velocity_[i].data<T>();
        const T* g = gradient.data<T>();
        const T momentum = static_cast<T>(options_.momentum), rate = static_cast<T>(learning_rate);
        Parallel::shared().for_chunks(gradient.size(), 1 << 14, [&](Index begin, Index end, int) {
          for (Index j = begin; j < end; ++j) {
            u[j] = momentum * u[j] - rate * g[j];
            p[j] += u[j];
          }
        });
      });
    }
  }

  std::vector<Tensor> state() const override { return velocity_; }

 private:
  std::vector<Tensor> parameters_, velocity_;
  SgdOptions options_;
};

}  // namespace

std::unique_ptr<Optimizer> sgd(std::vector<Tensor> parameters, const SgdOptions& options) {
  return std::make_unique<Sgd>(std::move(parameters), options);
}

}  // namespace svnet
