#include "nn/layers/layer.h"

#include <utility>

#include "base/text.h"

namespace svnet {
namespace {

template <class L>
void add_classes(std::vector<Layer>& layers) {
  if constexpr (requires { L::keras_classes(); })
    for (const L& layer : L::keras_classes()) layers.emplace_back(layer);
  else
    layers.emplace_back(L{});
}

/// A layer of each Keras class.
template <std::size_t... I>
std::vector<Layer> all_classes(std::index_sequence<I...>) {
  std::vector<Layer> layers;
  (add_classes<std::variant_alternative_t<I, Layer>>(layers), ...);
  return layers;
}

}  // namespace

const char* keras_name(const Layer& layer) {
  return std::visit([](const auto& l) { return l.keras_name(); }, layer);
}

Layer layer_of_class(const std::string& name) {
  std::vector<std::string> known;
  for (const Layer& layer : all_classes(std::make_index_sequence<std::variant_size_v<Layer>>())) {
    if (name == keras_name(layer)) return layer;
    known.emplace_back(keras_name(layer));
  }
  fail("unknown kind of layer '", name, "'", suggestion(name, known));
}

std::vector<ParameterSpec> parameters(const Layer& layer, const Shapes& inputs) {
  return std::visit([&](const auto& l) { return l.parameters(inputs); }, layer);
}

Shape output_shape(const Layer& layer, const Shapes& inputs) {
  Shape shape = std::visit([&](const auto& l) { return l.output_shape(inputs); }, layer);
  constexpr Index kMostOfAxis = Index{1} << 31, kMost = Index{1} << 40;
  Index count = 1;
  for (Index size : shape) {
    check(size > 0 && size < kMostOfAxis && count <= kMost / size, "[", keras_name(layer), "] gives ", to_string(shape),
          ", which is empty or too large");
    count *= size;
  }
  return shape;
}

}  // namespace svnet
