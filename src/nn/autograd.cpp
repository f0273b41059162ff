#include "nn/autograd.h"

#include <utility>

#include "base/parallel.h"
#include "nn/kernels/gemm.h"

namespace svnet::autograd {
Tensor record(Tensor output, const std::vector<Tensor>& inputs, Backward backward) {
  std::vector<std::shared_ptr<Node>> nodes;
  nodes.reserve(inputs.size());
  bool wanted = false;
  for (const auto& input : inputs) {
    nodes.push_back(input.node());
    wanted = wanted || input.wants_gradient();
  }
  if (!wanted) return output.detached();
  return output.with_node(std::make_shared<Node>(std::move(nodes), std::move(backward)));
}

void accumulate(Tensor& a, const Tensor& b) {
  check(a.unique() && a.shape() == b.shape() && a.dtype() == b.dtype(), "[autograd] cannot add a gradient of ",
        to_string(b.shape()), " to one of ", to_string(a.shape()));
  with_dtype(a.dtype(), [&]<class T>() {
    T* to = a.data<T>();
    const T* from = b.data<T>();
    Parallel::shared().for_chunks(a.size(), 1 << 16, [&](Index begin, Index end, int) {
      for (Index i = begin; i < end; ++i) to[i] += from[i];
    });
  });
}

namespace {

/// sum += gradient. Copies elements that other handles share before it changes them.
void add_to(Tensor& sum, Tensor gradient) {
  if (!sum.defined()) {
    sum = std::move(gradient);
  } else {
    if (!sum.unique()) sum = sum.clone();
    accumulate(sum, gradient);
  }
}

Tensor product(const Tensor& x, const Tensor& dy) {
  Tensor dw = Tensor::empty({x.dim(1), dy.dim(1)}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    kernels::gemm<T>(Parallel::shared(), {.m = x.dim(1), .n = dy.dim(1), .k = x.dim(0), .transpose_a = true},
                     x.data<T>(), dy.data<T>(), dw.data<T>());
  });
  return dw;
}

}  // namespace

void Sink::add_product(const Node& parameter, const Tensor& x, const Tensor& dy) { add(parameter, product(x, dy)); }

void GradientMap::add(const Node& parameter, Tensor gradient) {
  Entry& entry = gradients_[&parameter];
  if (entry.product.x.defined()) {
    entry.sum = product(entry.product.x, entry.product.dy);
    entry.product = {};
  }
  add_to(entry.sum, std::move(gradient));
}

void GradientMap::add_product(const Node& parameter, const Tensor& x, const Tensor& dy) {
  Entry& entry = gradients_[&parameter];
  if (products_ == Products::keep && !entry.sum.defined() && !entry.product.x.defined())
    entry.product = {x, dy};
  else
    add(parameter, product(x, dy));
}

Tensor GradientMap::of(const Tensor& parameter) const {
  const auto found = gradients_.find(parameter.node().get());
  if (found == gradients_.end()) return {};
  const Entry& entry = found->second;
  return entry.product.x.defined() ? product(entry.product.x, entry.product.dy) : entry.sum;
}

const GradientMap::Product* GradientMap::product_of(const Tensor& parameter) const {
  const auto found = gradients_.find(parameter.node().get());
  return found != gradients_.end() && found->second.product.x.defined() ? &found->second.product : nullptr;
}

/// One run of the tape. It holds the nodes that were reached and have not run yet, with their gradients.
class Pass {
 public:
  explicit Pass(Sink& sink) : sink_(sink) {}

  void add(const std::shared_ptr<Node>& node, Tensor gradient) {
    if (node->is_leaf()) {
      sink_.add(*node, std::move(gradient));
    } else {
      Entry& entry = waiting_[node->order_];
      entry.node = node;
      add_to(entry.gradient, std::move(gradient));
    }
  }

  void add_product(const std::shared_ptr<Node>& node, const Tensor& x, const Tensor& dy) {
    if (node->is_leaf())
      sink_.add_product(*node, x, dy);
    else
      add(node, product(x, dy));
  }

  void run() {
    while (!waiting_.empty()) {
      Entry entry = std::move(waiting_.rbegin()->second);
      waiting_.erase(std::prev(waiting_.end()));
      Backward backward = std::exchange(entry.node->backward_, nullptr);
      check(backward != nullptr, "[backward] this part of the tape was already run");
      Gradients gradients(*this, *entry.node);
      backward(entry.gradient, gradients);
    }
  }

 private:
  struct Entry {
    std::shared_ptr<Node> node;
    Tensor gradient;
  };
  Sink& sink_;
  std::map<std::uint64_t, Entry> waiting_;
};

void Gradients::add(std::size_t i, Tensor gradient) {
  if (wants(i)) pass_.add(node_.inputs_[i], std::move(gradient));
}

void Gradients::add_product(std::size_t i, const Tensor& x, const Tensor& dy) {
  if (wants(i)) pass_.add_product(node_.inputs_[i], x, dy);
}

void backward(const Tensor& output, Sink& sink, Tensor seed) {
  check(output.wants_gradient(), "[backward] the output does not depend on any parameter");
  if (!seed.defined()) {
    check(output.size() == 1, "[backward] an output of ", to_string(output.shape()), " needs a gradient to start from");
    seed = Tensor::full(output.shape(), 1.0, output.dtype());
  }
  check(seed.shape() == output.shape() && seed.dtype() == output.dtype(), "[backward] gradient of ",
        to_string(seed.shape()), " does not fit an output of ", to_string(output.shape()));
  Pass pass(sink);
  pass.add(output.node(), std::move(seed));
  pass.run();
}

}  // namespace svnet::autograd
