#pragma once
#include <map>
#include <memory>
#include <vector>

#include "nn/autograd_node.h"
#include "nn/tensor.h"

namespace svnet::autograd {

/// `output`, recorded on the tape as the result of an operation on `inputs` whose gradient is `backward`. If no input
/// wants a gradient, nothing is recorded and the closure is dropped; so inference keeps no activations.
Tensor record(Tensor output, const std::vector<Tensor>& inputs, Backward backward);

/// Receives the gradients of parameters. Calls come in descending order of the creation of the operations.
class Sink {
 public:
  virtual ~Sink() = default;
  /// One contribution to the gradient of `parameter`.
  virtual void add(const Node& parameter, Tensor gradient) = 0;
  /// The contribution xᵀ·dy, x (M, C) and dy (M, K), of a dense layer. This one computes the product and calls add(); a
  /// sink that uses the factors overrides it.
  virtual void add_product(const Node& parameter, const Tensor& x, const Tensor& dy);
};

/// The usual sink: the sum of each parameter's contributions.
class GradientMap : public Sink {
 public:
  /// The factors of a gradient xᵀ·dy that was not computed, so that an optimizer may compute it tile by tile.
  struct Product {
    Tensor x, dy;
  };
  /// compute: products are added up. keep: a parameter's only product is kept as its factors.
  enum class Products { compute, keep };
  explicit GradientMap(Products products = Products::compute) : products_(products) {}

  void add(const Node& parameter, Tensor gradient) override;
  void add_product(const Node& parameter, const Tensor& x, const Tensor& dy) override;
  /// The parameter's gradient, or an empty handle if it received none. A kept product is computed in each call.
  Tensor of(const Tensor& parameter) const;
  /// The product that was kept, if it is all that the parameter received, else nullptr.
  const Product* product_of(const Tensor& parameter) const;
  void clear() { gradients_.clear(); }

 private:
  struct Entry {
    Tensor sum{};
    Product product{};  // used if sum is empty
  };
  Products products_;
  std::map<const Node*, Entry> gradients_;
};

/// What a closure writes to: the gradients of the inputs of the node that is being visited.
class Gradients {
 public:
  bool wants(std::size_t i) const { return node_.inputs_[i] != nullptr; }
  /// Adds a gradient of the input's shape and dtype. Ignored if the input wants none.
  void add(std::size_t i, Tensor gradient);
  /// Adds xᵀ·dy, x (M, C) and dy (M, K). A parameter receives the factors (Sink::add_product), other inputs the
  /// product.
  void add_product(std::size_t i, const Tensor& x, const Tensor& dy);

 private:
  friend class Pass;
  Gradients(class Pass& pass, const Node& node) : pass_(pass), node_(node) {}
  class Pass& pass_;
  const Node& node_;
};

/// Runs the tape from `output`, whose gradient is `seed`, in descending order of creation, and gives the gradients of
/// the leaves to `sink`. An empty seed means 1. Requires an output of one element then.
/// Throws Error the second time: closures are released as they run.
void backward(const Tensor& output, Sink& sink, Tensor seed = {});

/// a += b elementwise. Requires a.unique().
void accumulate(Tensor& a, const Tensor& b);

}  // namespace svnet::autograd
