#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/parallel.h"
#include "nn/kernels/activation/activation.h"
#include "nn/kernels/epilogue.h"
#include "nn/kernels/packed/byte_input.h"
#include "nn/kernels/precision.h"
#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::runtime {

/// What a step reads and writes: batches of images or rows. All may be read one vector past their end.
struct StepBuffers {
  std::span<const float* const> inputs;
  float* output;
  float* scratch;  ///< Step::scratch floats
  Index batch;
  Parallel& parallel;
};

/// Is given the left operand of a product, `channels` wide, in f32. `layer` multiplies it.
using ProductObserver =
    std::function<void(const std::string& layer, Index rows, const kernels::PanelRows& a, Index channels)>;

/// One kernel call of a compiled graph, with its weights in the layout of the kernel. Immutable: several threads may
/// run it at once, each with its own buffers.
class Step {
 public:
  virtual ~Step() = default;
  virtual void run(const StepBuffers& buffers) const = 0;
  /// Number of floats of scratch memory that a run needs.
  virtual Index scratch(Index batch, int threads) const {
    static_cast<void>(batch);
    static_cast<void>(threads);
    return 0;
  }
  /// Shows the left operand of the product that int8 can multiply, if the step has one. To be called before run.
  virtual void observe(const StepBuffers&, const ProductObserver&) const {}
  virtual std::string kernel() const = 0;     ///< its name in reports: "winograd 3x3"
  virtual double flops() const { return 0; }  ///< of one sample, by the definition of the layer
  virtual double weight_bytes() const { return 0; }
};

using StepPointer = std::unique_ptr<const Step>;

/// What a convolution also does to its output: y = clamp(y + bias + residual), then 2×2 pooling if `pool`.
struct ConvolutionFinish {
  kernels::Clamp clamp = kernels::Clamp::none;
  bool residual = false;  ///< the step's second input
  bool pool = false;      ///< Winograd only: the maximum of every 2×2
};

/// How a step multiplies.
struct Product {
  kernels::Precision precision = kernels::Precision::f32;
  const kernels::ChannelRanges* ranges = nullptr;  ///< of the left operand; of int8 only
  std::string layer{};                             ///< that it is for, for observers and messages
};

/// Whether a convolution multiplies in another precision than f32. In first layers the rows of a window are so short
/// that rounding them costs more than the products save.
inline bool rounds_products(const Window& window) {
  return window.kh == 1 || window.kw * window.c >= 2 * kernels::kPanel;
}

// Windows are those of a batch of 1. bias may be an empty handle.

/// `winograd`: by Winograd's algorithm in f32. Requires that it fits the window (winograd_fits).
StepPointer convolution_step(const Window& window, const Tensor& kernel, const Tensor& bias,
                             const ConvolutionFinish& finish, bool winograd, const Product& product);
StepPointer dense_step(const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish,
                       kernels::Precision precision);
/// With the weights rounded to int8.
StepPointer int8_dense_step(const Tensor& kernel, const Tensor& bias, const ConvolutionFinish& finish);

/// The depthwise half of a separable convolution, in f32: clamp(depthwise(x or relu(x)) + bias).
struct DepthwisePart {
  Tensor kernel, bias{};
  bool relu_input = false;
  kernels::Clamp clamp = kernels::Clamp::none;
};
StepPointer separable_step(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise,
                           const Tensor& bias, const ConvolutionFinish& finish, const Product& product);
/// A 1×1 convolution whose output a separable one reads: clamp(x · kernel + bias).
struct ExpansionPart {
  Tensor kernel, bias{};
  kernels::Clamp clamp = kernels::Clamp::none;
  Product product{};
};
StepPointer expanded_separable_step(const Window& window, const ExpansionPart& expansion,
                                    const DepthwisePart& depthwise, const Tensor& pointwise, const Tensor& bias,
                                    const ConvolutionFinish& finish, const Product& product);
/// A separable convolution, a clamp, and the maximum of each window of `pool`.
StepPointer separable_max_pool_step(const Window& window, const DepthwisePart& depthwise, const Tensor& pointwise,
                                    const Tensor& bias, kernels::Clamp clamp, const Window& pool,
                                    const Product& product);
StepPointer depthwise_step(const Window& window, const DepthwisePart& depthwise, Index multiplier);

StepPointer pool_step(const Window& window, bool max);
/// The sum of the inputs.
StepPointer add_step(Index size, std::size_t inputs, kernels::Clamp clamp);
/// y = clamp(x · scale + shift), per channel of the last axis.
StepPointer scale_shift_step(Index rows, const Tensor& scale, const Tensor& shift, kernels::Clamp clamp);
/// On rows of `columns` elements, over which softmax is taken.
StepPointer activation_step(Index rows, Index columns, Activation activation);
/// Joins rows along the last axis.
StepPointer concat_step(Index rows, std::vector<Index> widths);
/// A border of zeros around images (H, W, C).
StepPointer padding_step(Index h, Index w, Index c, const Padding& padding);
StepPointer copy_step(Index size);

}  // namespace svnet::runtime
