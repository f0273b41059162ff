#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace svnet {
class Tensor;
}

namespace svnet::autograd {

class Gradients;

/// Turns the gradient of a node's output into gradients of its inputs. It owns copies of only the tensors that it
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

}  // namespace svnet::autograd
