#pragma once
#include <vector>

#include "nn/kernels/window.h"
#include "nn/layers/parameter_spec.h"
#include "nn/tensor.h"

namespace svnet {

// What several layers share when they check their inputs. Shapes leave out the batch. `layer` is the Keras class name
// that begins the messages.

using Shapes = std::vector<Shape>;

/// The shape of a layer's only input. Throws Error unless there is exactly one.
const Shape& only_input(const char* layer, const Shapes& inputs);

/// The same, of images (H, W, C). Throws Error for another number of axes.
const Shape& only_images(const char* layer, const Shapes& inputs);

/// Size of the first input's last axis; 0 if there is none.
Index channels_of(const Shapes& inputs);

/// The output shape (OH, OW, channels) of a window that slides over the only input. Throws Error if it does not fit.
Shape window_output(const char* layer, const Shapes& inputs, const WindowOptions& window, Index channels);

/// Appends the parameter "bias" (size), if the layer has one.
void add_bias(std::vector<ParameterSpec>& parameters, bool bias, Index size);

/// The window of a convolution layer.
WindowOptions window_of(const auto& layer) {
  return {
      .kh = layer.kh, .kw = layer.kw, .stride_h = layer.stride_h, .stride_w = layer.stride_w, .padding = layer.padding};
}

/// Visits the fields of anything with a window.
void visit_window(auto& windowed, auto& field) {
  field("kernel_height", windowed.kh);
  field("kernel_width", windowed.kw);
  field("stride_height", windowed.stride_h);
  field("stride_width", windowed.stride_w);
  field("padding", windowed.padding);
}

}  // namespace svnet
