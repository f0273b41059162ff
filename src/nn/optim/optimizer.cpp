#include "nn/optim/optimizer.h"

#include <algorithm>

namespace svnet {

void Optimizer::restore(const std::vector<Tensor>& saved, std::int64_t done) {
  std::vector<Tensor> own = state();
  check(saved.empty() || saved.size() == own.size(), "[optimizer] the saved state has ", saved.size(),
        " tensors, expected ", own.size());
  for (std::size_t i = 0; i < saved.size(); ++i) {
    check(saved[i].shape() == own[i].shape() && saved[i].dtype() == own[i].dtype(), "[optimizer] saved tensor ", i,
          " is ", to_string(saved[i].shape()), ", expected ", to_string(own[i].shape()));
    with_dtype(own[i].dtype(), [&]<class T>() { std::copy_n(saved[i].data<T>(), saved[i].size(), own[i].data<T>()); });
  }
  for (std::size_t i = 0; saved.empty() && i < own.size(); ++i)
    with_dtype(own[i].dtype(), [&]<class T>() { std::fill_n(own[i].data<T>(), own[i].size(), T{0}); });
  steps = done;
}

std::unique_ptr<Optimizer> make_optimizer(std::vector<Tensor> parameters, const OptimizerOptions& options) {
  switch (options.kind) {
    case OptimizerKind::adam:
      return adam(std::move(parameters));
    case OptimizerKind::sgd:
      return sgd(std::move(parameters), {.momentum = options.momentum});
  }
  return nullptr;
}

int moments(OptimizerKind kind) {
  switch (kind) {
    case OptimizerKind::adam:
      return 2;
    case OptimizerKind::sgd:
      return 1;
  }
  return 0;
}

}  // namespace svnet
