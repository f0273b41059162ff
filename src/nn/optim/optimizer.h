#pragma once
#include <memory>
#include <vector>

#include "base/enum_names.h"
#include "nn/autograd.h"
#include "nn/tensor.h"

namespace svnet {

/// Changes parameters by their gradients. Its state (moments, velocities) is public for checkpoints.
class Optimizer {
 public:
  virtual ~Optimizer() = default;
  /// One step at the given learning rate. Parameters without a gradient stay as they are.
  virtual void step(const autograd::GradientMap& gradients, double learning_rate) = 0;
  /// The tensors to save with the parameters, in a fixed order. The handles share the elements, which later steps
  /// change.
  virtual std::vector<Tensor> state() const = 0;
  /// Continues from the state after `done` steps; an empty state means the initial one. Throws Error if the shapes are
  /// not those of state().
  void restore(const std::vector<Tensor>& saved, std::int64_t done);
  /// Steps done so far.
  std::int64_t steps = 0;
};

/// Adam in the "ε̂" form of Kingma and Ba (2015, end of section 2), as Keras has it:
///   m ← β₁m + (1 − β₁)g,  v ← β₂v + (1 − β₂)g²,  θ ← θ − rate · √(1 − β₂ᵗ) / (1 − β₁ᵗ) · m / (√v + ε).
/// Weight decay comes before: θ ← θ − rate · decay · θ (Loshchilov and Hutter, "Decoupled weight decay regularization",
/// 2019). It applies only to tensors of two axes or more, so not to biases and batch norms.
struct AdamOptions {
  double beta1 = 0.9, beta2 = 0.999, epsilon = 1e-7, weight_decay = 0;
};
std::unique_ptr<Optimizer> adam(std::vector<Tensor> parameters, const AdamOptions& options = {});

/// SGD with momentum as Keras has it: u ← momentum · u − rate · g,  θ ← θ + u.
struct SgdOptions {
  double momentum = 0;
};
std::unique_ptr<Optimizer> sgd(std::vector<Tensor> parameters, const SgdOptions& options = {});

enum class OptimizerKind { adam, sgd };
constexpr auto enum_table(OptimizerKind) {
  return std::to_array<EnumName<OptimizerKind>>({{OptimizerKind::adam, "adam"}, {OptimizerKind::sgd, "sgd"}});
}

/// The optimizer that a kind names.
struct OptimizerOptions {
  OptimizerKind kind = OptimizerKind::adam;
  double momentum = 0.9;  ///< sgd
};
std::unique_ptr<Optimizer> make_optimizer(std::vector<Tensor> parameters, const OptimizerOptions& options);
/// How many tensors of each parameter's shape are in state(): all of the first, then all of the second.
int moments(OptimizerKind kind);

}  // namespace svnet
