#pragma once
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "nn/tensor.h"

namespace svnet::autograd {

class Gradients;

/// Turns the gradient of a node's output into gradients of its inputs. It owns copies of just those tensors that it
/// needs; they are released as soon as it has run.
using Backward = std::function<void(const Tensor& dy, Gradients& gradients)>;

/// One operation on the tape, or a leaf (a parameter). Nodes hold their inputs' nodes, never their values.
class Node {
 public:
  Node(std::vector<std::shared_ptr<Node>> inputs, Backward backward);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  bool is_leaf() const { return leaf_; }

 private:
  friend class Gradients;
  friend class Pass;
  std::uint64_t order_;  // of creation
  bool leaf_;
  std::vector<std::shared_ptr<Node>> inputs_;
  Backward backward_;
};

/// A new leaf.
std::shared_ptr<Node> leaf();

/// `output` as the result of `backward`'s forward on `inputs`. Where no input wants a gradient nothing is recorded and
/// the closure is dropped, which is how inference keeps no activations.
Tensor record(Tensor output, const std::vector<Tensor>& inputs, Backward backward);

/// Where the gradients of parameters go. Calls come in descending order of the creation of the operations.
class Sink {
 public:
  virtual ~Sink() = default;
  /// One contribution to the gradient of `parameter`.
  virtual void add(const Node& parameter, Tensor gradient) = 0;
  /// The contribution xᵀ·dy, x (M, C) and dy (M, K), of a dense layer. A sink that never wants the product formed
  /// overrides this; here it is formed and handed to add().
  virtual void add_product(const Node& parameter, const Tensor& x, const Tensor& dy);
};

/// The usual sink: the sum of each parameter's contributions.
class GradientMap : public Sink {
 public:
  /// Products xᵀ·dy that are kept unformed, so that an optimizer may form them tile by tile while it uses them.
  struct Product {
    Tensor x, dy;
  };
  enum class Products { form, keep };
  explicit GradientMap(Products products = Products::form) : products_(products) {}

  void add(const Node& parameter, Tensor gradient) override;
  void add_product(const Node& parameter, const Tensor& x, const Tensor& dy) override;
  /// Empty handle where the parameter received nothing. A kept product is formed here, each time.
  Tensor of(const Tensor& parameter) const;
  /// Whether all that the parameter received is one product that was kept; then that product, else nullptr.
  const Product* product_of(const Tensor& parameter) const;
  void clear() { gradients_.clear(); }

 private:
  struct Entry {
    Tensor sum{};
    Product product{};  // where sum is empty
  };
  Products products_;
  std::map<const Node*, Entry> gradients_;
};

/// What a closure writes to: input `i` of the node that is being visited.
class Gradients {
 public:
  bool wants(std::size_t i) const { return node_.inputs_[i] != nullptr; }
  /// Adds a gradient of the input's shape and dtype. Ignored where the input wants none.
  void add(std::size_t i, Tensor gradient);
  /// Adds xᵀ·dy, x (M, C) and dy (M, K), reshaped to the input: passed on unformed where the input is a parameter.
  void add_product(std::size_t i, const Tensor& x, const Tensor& dy);

 private:
  friend class Pass;
  Gradients(class Pass& pass, const Node& node) : pass_(pass), node_(node) {}
  class Pass& pass_;
  const Node& node_;
};

/// Runs the tape from `output`, whose gradient is `seed` (ones where empty; output must then have one element), in
/// descending order of creation, and gives the gradients of the leaves to `sink`. A tape can be run once (Error on the
/// second time): its closures are released on the way.
void backward(const Tensor& output, Sink& sink, Tensor seed = {});

/// a += b elementwise; a must be unique.
void accumulate(Tensor& a, const Tensor& b);

}  // namespace svnet::autograd
