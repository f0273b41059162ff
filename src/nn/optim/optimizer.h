#pragma once
#include <memory>
#include <vector>

#include "base/enum_names.h"
#include "nn/autograd.h"
#include "nn/tensor.h"

namespace svnet {

/// Changes parameters by their gradients. State (moments, velocities) is exposed for checkpoints.
class Optimizer {
 public:
  virtual ~Optimizer() = default;
  /// One step at the given learning rate. Parameters without a gradient stay as they are.
  virtual void step(const autograd::GradientMap& gradients, double learning_rate) = 0;
  /// Tensors that must be saved and restored with the parameters, in a fixed order; they follow later steps.
  virtual std::vector<Tensor> state() const = 0;
  /// Goes on from a saved state after `done` steps; an empty state is that of the start. Throws Error where the shapes
  /// are not those of state().
  void restore(const std::vector<Tensor>& saved, std::int64_t done);
  /// Steps done so far.
  std::int64_t steps = 0;
};

/// Adam in the "ε̂" form of Kingma and Ba (2015, end of section 2), as Keras has it:
///   m ← β₁m + (1 − β₁)g,  v ← β₂v + (1 − β₂)g²,  θ ← θ − rate · √(1 − β₂ᵗ) / (1 − β₁ᵗ) · m / (√v + ε).
/// With weight decay θ ← θ − rate · decay · θ comes before (Loshchilov and Hutter, "Decoupled weight decay
/// regularization", 2019), for kernels alone: tensors of two axes or more.
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
template <>
inline constexpr auto enum_names<OptimizerKind> = std::to_array<EnumName<OptimizerKind>>({{OptimizerKind::adam, "adam"},
                                                                                          {OptimizerKind::sgd, "sgd"}});

/// The optimizer that a kind names.
struct OptimizerOptions {
  OptimizerKind kind = OptimizerKind::adam;
  double momentum = 0.9;  ///< sgd
};
std::unique_ptr<Optimizer> make_optimizer(std::vector<Tensor> parameters, const OptimizerOptions& options);
/// How many tensors of each parameter's shape are in state(): all of the first, then all of the second.
int moments(OptimizerKind kind);

}  // namespace svnet
