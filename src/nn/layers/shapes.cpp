#include "nn/layers/shapes.h"

namespace svnet {

const Shape& only_input(const char* layer, const Shapes& inputs) {
  check(inputs.size() == 1, "[", layer, "] takes one input, got ", inputs.size());
  return inputs[0];
}

const Shape& only_images(const char* layer, const Shapes& inputs) {
  const Shape& input = only_input(layer, inputs);
  check(input.size() == 3, "[", layer, "] expects images HxWxC, got ", to_string(input));
  return input;
}

Index channels_of(const Shapes& inputs) { return inputs.empty() || inputs[0].empty() ? 0 : inputs[0].back(); }

Shape window_output(const char* layer, const Shapes& inputs, const WindowOptions& window, Index channels) {
  const Shape& input = only_images(layer, inputs);
  const Window w = window_over(layer, 1, input[0], input[1], input[2], window);
  return {w.oh, w.ow, channels};
}

void add_bias(std::vector<ParameterSpec>& parameters, bool bias, Index size) {
  if (bias) parameters.push_back({"bias", {size}, Initializer::zeros});
}

}  // namespace svnet
