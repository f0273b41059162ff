#include "base/text.h"
#include "nn/kernels/conv2d/packed_conv2d.h"
#include "nn/kernels/depthwise/depthwise.h"
#include "nn/kernels/int8/int8_gemm.h"
#include "nn/kernels/separable/fused_separable.h"
#include "nn/kernels/winograd/winograd.h"
#include "nn/runtime/step.h"

namespace svnet::runtime {
namespace {

using namespace kernels;

/// The elements of a tensor, nullptr for an empty handle.
const float* data_of(const Tensor& t) { return t.defined() ? t.data<float>() : nullptr; }

Window with_batch(Window window, Index batch) {
  window.n = batch;
  return window;
}

std::string size_text(const Window& w) { return joined(w.kh, "x", w.kw); }

std::string gemm_text(const PackedWeights& weights) {
  return weights.precision == Precision::f32 ? "packed gemm" : joined(name_of(weights.precision), " gemm");
}
std::string implicit_text(const PackedWeights& weights) {
  return weights.precision == Precision::f32 ? "implicit gemm" : joined(name_of(weights.precision), " implicit gemm");
}

/// The weights of a product (depth, n) in the layout of its kernel. `clamp` limits the left operand.
PackedWeights weights_of(const Product& product, Index depth, const Tensor& kernel, const Tensor& bias,
                         Clamp clamp = Clamp::none) {
  const Index n = kernel.dim(-1);
  if (product.precision != Precision::int8)
    return packed_weights(depth, n, data_of(kernel), data_of(bias), product.precision);
  ChannelRanges ranges = *product.ranges;
  const auto limits = range_of(clamp);
  for (float& low : ranges.low) low = limits.clamped(low);
  for (float& high : ranges.high) high = limits.clamped(high);
  return packed_int8_weights(depth, n, data_of(kernel), data_of(bias), ranges);
}

PackedFinish packed_finish(const ConvolutionFinish& finish, const StepBuffers& b) {
  return {finish.clamp, finish.residual ? b.inputs[1] : nullptr};
}

class PackedConvolution : public Step {
 public:
  PackedConvolution(const Window& window, const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish,
                    const Product& product)
      : window_(window),
        weights_(weights_of(product, kernel.size() / kernel.dim(-1), kernel, bias)),
        finish_(finish),
        layer_(product.layer) {}

  void run(const StepBuffers& b) const override {
    packed_conv2d(b.parallel, with_batch(window_, b.batch), b.inputs[0], weights_, packed_finish(finish_, b), b.output,
                  b.scratch);
  }
  Index scratch(Index batch, int threads) const override {
    return packed_conv2d_scratch(with_batch(window_, batch), threads, weights_.precision);
  }
  void observe(const StepBuffers& b, const ProductObserver& observer) const override {
    if (!layer_.empty()) observer(layer_, b.batch * window_.h * window_.w, {b.inputs[0], window_.c, kPanel}, window_.c);
  }
  std::string kernel() const override {
    return joined(window_.reads_in_place() ? gemm_text(weights_) : implicit_text(weights_), " ", size_text(window_));
  }
  double flops() const override { return 2.0 * static_cast<double>(window_.positions() * weights_.depth * weights_.n); }
  double weight_bytes() const override { return 4.0 * static_cast<double>(weights_.panel_rows * weights_.n); }

 private:
  Window window_;
  PackedWeights weights_;
  ConvolutionFinish finish_;
  std::string layer_;  // "": observers do not see it
};

class Int8Dense : public Step {
 public:
  Int8Dense(const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish)
      : weights_(packed_int8(kernel.dim(0), kernel.dim(1), data_of(kernel), data_of(bias))), finish_(finish) {}

  void run(const StepBuffers& b) const override {
    int8_gemm(b.parallel, b.batch, b.inputs[0], weights_, packed_finish(finish_, b), b.output, b.scratch);
  }
  Index scratch(Index, int threads) const override { return int8_gemm_scratch(threads); }
  std::string kernel() const override { return "int8 gemm 1x1"; }
  double flops() const override { return 2.0 * static_cast<double>(weights_.depth * weights_.n); }
  double weight_bytes() const override { return static_cast<double>(weights_.depth * weights_.n); }

 private:
  PackedInt8 weights_;
  ConvolutionFinish finish_;
};

class WinogradConvolution : public Step {
 public:
  WinogradConvolution(const Window& window, const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish)
      : window_(window),
        weights_(winograd_weights(window.c, kernel.dim(-1), data_of(kernel), data_of(bias))),
        finish_{finish.clamp, finish.pool} {}

  void run(const StepBuffers& b) const override {
    winograd_conv2d(b.parallel, with_batch(window_, b.batch), b.inputs[0], weights_, finish_, b.output, b.scratch);
  }
  Index scratch(Index batch, int threads) const override {
    return winograd_scratch(with_batch(window_, batch), weights_, threads);
  }
  std::string kernel() const override { return finish_.pool ? "winograd 3x3 + pool 2x2" : "winograd 3x3"; }
  double flops() const override { return 18.0 * static_cast<double>(window_.positions() * weights_.c * weights_.k); }
  double weight_bytes() const override {
    return (weights_.transformed ? 144.0 : 36.0) * static_cast<double>(weights_.c * weights_.k);
  }

 private:
  Window window_;
  WinogradWeights weights_;
  WinogradFinish finish_;
};

class Separable : public Step {
 public:
  Separable(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise, const Tensor& bias,
            const ConvolutionFinish& finish, const Product& product)
      : window_(window),
        taps_(depthwise_taps(window.kh, window.kw, window.c, data_of(depthwise.kernel), data_of(depthwise.bias))),
        weights_(weights_of(product, window.c, pointwise, bias, depthwise.clamp)),
        finish_(finish),
        layer_(product.layer) {
    taps_.relu_input = depthwise.relu_input;
    taps_.clamp = depthwise.clamp;
    if (product.precision == Precision::int8) round_taps(weights_.input, taps_);
  }

  void run(const StepBuffers& b) const override {
    separable_conv2d(b.parallel, with_batch(window_, b.batch), b.inputs[0], taps_, weights_, packed_finish(finish_, b),
                     b.output, b.scratch);
  }
  Index scratch(Index batch, int threads) const override {
    return separable_scratch(with_batch(window_, batch), threads, weights_.precision);
  }
  void observe(const StepBuffers& b, const ProductObserver& observer) const override {
    const Window w = with_batch(window_, b.batch);
    const Index rows = w.positions();
    const AlignedFloats between = aligned_floats(rows * panels(w.c) * kPanel);
    depthwise_rows(w, taps_, b.inputs[0], 0, rows, between.get());
    observer(layer_, rows, {between.get(), kPanel, kPanel * rows}, w.c);
  }
  std::string kernel() const override { return joined("depthwise ", size_text(window_), " + ", gemm_text(weights_)); }
  double flops() const override {
    return 2.0 * static_cast<double>(window_.positions() * window_.c * (window_.kh * window_.kw + weights_.n));
  }
  double weight_bytes() const override {
    return 4.0 * static_cast<double>(window_.c * window_.kh * window_.kw + weights_.panel_rows * weights_.n);
  }

 protected:
  Window window_;
  DepthwiseTaps taps_;
  PackedWeights weights_;
  ConvolutionFinish finish_;
  std::string layer_;
};

class ExpandedSeparable : public Separable {
 public:
  ExpandedSeparable(const Window& window, const ExpansionPart& expansion, const DepthwisePart& depthwise,
                    const Tensor& pointwise, const Tensor& bias, const ConvolutionFinish& finish,
                    const Product& product)
      : Separable(window, depthwise, pointwise, bias, finish, product),
        expansion_(weights_of(expansion.product, expansion.kernel.size() / window.c, expansion.kernel, expansion.bias)),
        clamp_(expansion.clamp) {}

  void run(const StepBuffers& b) const override {
    expanded_separable_conv2d(b.parallel, with_batch(window_, b.batch), b.inputs[0], expansion_, clamp_, taps_,
                              weights_, packed_finish(finish_, b), b.output, b.scratch);
  }
  Index scratch(Index, int threads) const override {
    return expanded_separable_scratch(window_, threads, expansion_.depth, weights_.precision);
  }
  std::string kernel() const override { return joined(gemm_text(expansion_), " + ", Separable::kernel()); }
  double flops() const override {
    return Separable::flops() + 2.0 * static_cast<double>(window_.h * window_.w * expansion_.depth * expansion_.n);
  }
  double weight_bytes() const override {
    return Separable::weight_bytes() + 4.0 * static_cast<double>(expansion_.panel_rows * expansion_.n);
  }

 private:
  PackedWeights expansion_;
  Clamp clamp_;
};

class SeparableMaxPool : public Separable {
 public:
  SeparableMaxPool(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise, const Tensor& bias,
                   Clamp clamp, const Window& pool, const Product& product)
      : Separable(window, depthwise, pointwise, bias, {.clamp = clamp}, product), pool_(pool) {}

  void run(const StepBuffers& b) const override {
    separable_max_pool(b.parallel, with_batch(window_, b.batch), b.inputs[0], taps_, weights_, finish_.clamp,
                       with_batch(pool_, b.batch), b.output, b.scratch);
  }
  Index scratch(Index, int threads) const override {
    return separable_max_pool_scratch(window_, pool_, threads, weights_.precision);
  }
  std::string kernel() const override { return joined(Separable::kernel(), " + max pool ", size_text(pool_)); }

 private:
  Window pool_;
};

/// A depthwise convolution that no pointwise one follows.
class Depthwise : public Step {
 public:
  Depthwise(const Window& window, const DepthwisePart& part, Index multiplier)
      : window_(window), part_(part), multiplier_(multiplier) {}

  void run(const StepBuffers& b) const override {
    depthwise(b.parallel, {with_batch(window_, b.batch), multiplier_}, b.inputs[0], data_of(part_.kernel), b.output,
              Epilogue<float>{data_of(part_.bias), part_.clamp});
  }
  std::string kernel() const override { return joined("depthwise ", size_text(window_)); }
  double flops() const override { return 2.0 * static_cast<double>(window_.positions() * part_.kernel.size()); }
  double weight_bytes() const override { return 4.0 * static_cast<double>(part_.kernel.size()); }

 private:
  Window window_;
  DepthwisePart part_;
  Index multiplier_;
};

}  // namespace

StepPointer convolution_step(const Window& window, const Tensor& kernel, const Tensor& bias,
                             const ConvolutionFinish& finish, bool winograd, const Product& product) {
  if (winograd) return std::make_unique<WinogradConvolution>(window, kernel, bias, finish);
  return std::make_unique<PackedConvolution>(window, kernel, bias, finish,
                                             rounds_products(window) ? product : Product{});
}

StepPointer dense_step(const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish, Precision precision) {
  return std::make_unique<PackedConvolution>(window_over("dense", 1, 1, 1, kernel.dim(0), {}), kernel, bias, finish,
                                             Product{.precision = precision});
}

StepPointer int8_dense_step(const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish) {
  return std::make_unique<Int8Dense>(kernel, bias, finish);
}

StepPointer separable_step(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise,
                           const Tensor& bias, const ConvolutionFinish& finish, const Product& product) {
  return std::make_unique<Separable>(window, depthwise, pointwise, bias, finish, product);
}

StepPointer expanded_separable_step(const Window& window, const ExpansionPart& expansion,
                                    const DepthwisePart& depthwise, const Tensor& pointwise, const Tensor& bias,
                                    const ConvolutionFinish& finish, const Product& product) {
  return std::make_unique<ExpandedSeparable>(window, expansion, depthwise, pointwise, bias, finish, product);
}

StepPointer separable_max_pool_step(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise,
                                    const Tensor& bias, Clamp clamp, const Window& pool, const Product& product) {
  return std::make_unique<SeparableMaxPool>(window, depthwise, pointwise, bias, clamp, pool, product);
}

StepPointer depthwise_step(const Window& window, const DepthwisePart& depthwise, Index multiplier) {
  return std::make_unique<Depthwise>(window, depthwise, multiplier);
}

}  // namespace svnet::runtime
