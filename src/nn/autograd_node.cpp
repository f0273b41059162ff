// Apart from autograd.cpp, so that a program that only infers links none of the kernels of training.
#include "nn/autograd_node.h"

#include <atomic>
#include <utility>

namespace svnet::autograd {
namespace {

std::uint64_t next_order() {
  static std::atomic<std::uint64_t> count{0};
  return count.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

Node::Node(std::vector<std::shared_ptr<Node>> inputs, Backward backward)
    : order_(next_order()), leaf_(!backward), inputs_(std::move(inputs)), backward_(std::move(backward)) {}

Node::~Node() {
  // A long chain is released link by link here, not by recursion through the shared pointers.
  std::vector<std::shared_ptr<Node>> pending = std::move(inputs_);
  while (!pending.empty()) {
    std::shared_ptr<Node> node = std::move(pending.back());
    pending.pop_back();
    if (node == nullptr || node.use_count() > 1) continue;
    for (auto& input : node->inputs_) pending.push_back(std::move(input));
    node->inputs_.clear();
  }
}

std::shared_ptr<Node> leaf() { return std::make_shared<Node>(std::vector<std::shared_ptr<Node>>{}, Backward{}); }

}  // namespace svnet::autograd
