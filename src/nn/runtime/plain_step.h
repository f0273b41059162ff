#pragma once
#include <memory>
#include <string>
#include <utility>

#include "nn/runtime/step.h"

namespace svnet::runtime {

/// A step without weights: one function of its buffers.
template <class Body>
class PlainStep : public Step {
 public:
  PlainStep(std::string kernel, double flops, Body body)
      : kernel_(std::move(kernel)), flops_(flops), body_(std::move(body)) {}
  void run(const StepBuffers& buffers) const override { body_(buffers); }
  std::string kernel() const override { return kernel_; }
  double flops() const override { return flops_; }

 private:
  std::string kernel_;
  double flops_;
  Body body_;
};

/// A step that calls body(buffers). `kernel` is its name in reports, `flops` are those of one sample.
template <class Body>
StepPointer plain_step(std::string kernel, Index flops, Body body) {
  return std::make_unique<PlainStep<Body>>(std::move(kernel), static_cast<double>(flops), std::move(body));
}

}  // namespace svnet::runtime
