#include "models/backbone.h"

#include <algorithm>
#include <memory>

#include <pybind11/stl.h>

#include "arguments.h"
#include "base/error.h"
#include "base/text.h"
#include "bindings.h"
#include "computing.h"
#include "io/models/backbone_file.h"

namespace svnet::python {
using models::Backbone;
using models::Preprocessing;

namespace {

namespace py = pybind11;

constexpr Index kBatch = 32;  // images per batch, to limit memory

constexpr const char* kClassDoc =
    R"(A convolutional network up to the layer whose output are the features. Threads may share one.

Parameters
----------
name : one of {names}
weights : path of a Keras HDF5 weights file (legacy layout or Keras 3 .weights.h5), or of a .safetensors file that
    svnet-pretrain wrote. The network has its top ("predictions") if the file has one.
    None: the built-in weights for tiny_xception, random weights for other networks; no top.
layer : Keras name of the output layer. None: the pooled output: block5_pool for VGG, else global average pooling
    (also called "avg_pool" or "global_average_pooling2d").
seed : int from 0 to 2^64 - 1, for random weights

Raises
------
svnet.Error for unknown names (the message says the nearest one), and for files that cannot be read or hold other
weights.
)";

constexpr const char* kInitDoc = R"(__init__(self, name, weights=None, layer=None, seed=0)
--

The class says what the parameters mean.
)";

constexpr const char* kFeaturesDoc = R"(features(self, images)
--

The features of images.

images : (N, H, W, 3) uint8, RGB, of the size of input_shape, not preprocessed; any strides.
Returns (N, D) float32 with D = dimension; an output (H', W', C) of the layer is flattened in this order.
Raises svnet.Error for another dtype or shape.
)";

struct LoadedBackbone {
  Backbone backbone;
  std::vector<std::string> unused_layers;

  /// pybind11 calls this if a method is called on an instance whose __init__ did not run or failed: the method would
  /// get memory without a backbone. So this throws, and new_backbone calls ::new.
  static void* operator new(std::size_t) {
    throw py::type_error("svnet.Backbone has no network yet; call svnet.Backbone(name, ...)");
  }
  static void operator delete(void* memory) { ::operator delete(memory); }
};

std::unique_ptr<LoadedBackbone> new_backbone(Backbone backbone, std::vector<std::string> unused_layers) {
  return std::unique_ptr<LoadedBackbone>(::new LoadedBackbone{std::move(backbone), std::move(unused_layers)});
}

std::unique_ptr<LoadedBackbone> load(const py::object& given_name, const py::object& given_weights,
                                     const py::object& given_layer, const py::object& given_seed) {
  const std::string name = text("Backbone", "name", given_name, "the name of a network");
  const std::string output =
      given_layer.is_none() ? "" : text("Backbone", "layer", given_layer, "the name of a layer, or None");
  const std::uint64_t seed = whole_number("Backbone", "seed", given_seed);
  const InferenceOptions options = inference_options_from_environment();
  if (given_weights.is_none()) {
    const Computing computing;
    if (auto built_in = io::built_in_backbone(name, output, options))
      return new_backbone(std::move(built_in->backbone), {});
    return new_backbone(models::random_backbone(name, output, seed, options), {});
  }
  const std::string weights = path("Backbone", "weights", given_weights);
  const Computing computing;
  io::KerasLoadReport report;
  Backbone backbone = read_backbone(name, weights, output, &report, options);
  return new_backbone(std::move(backbone), std::move(report.unused));
}

Tensor preprocessed(const Preprocessing& how, const std::uint8_t* rgb, Index images) {
  Tensor batch = Tensor::empty({images, how.height, how.width, 3});
  Parallel::shared().for_chunks(images, 1, [&](Index i, Index, int) {
    preprocess(how.mode, rgb + i * how.size(), how.height * how.width, batch.data<float>() + i * how.size());
  });
  return batch;
}

py::array_t<float> features(const LoadedBackbone& self, const py::object& given) {
  const Backbone& backbone = self.backbone;
  const Preprocessing& how = backbone.preprocessing();
  const Array<std::uint8_t> batch = images("Backbone.features", given);
  check(batch.shape(1) == how.height && batch.shape(2) == how.width, "[Backbone.features] images are ", batch.shape(1),
        "x", batch.shape(2), ", ", backbone.kind().name, " takes ", how.height, "x", how.width, "; resize them first");
  const Index n = batch.shape(0), dimension = backbone.dimension();
  py::array_t<float> result({n, dimension});
  const std::uint8_t* rgb = batch.data();
  float* to = result.mutable_data();
  const Computing computing;
  for (Index first = 0; first < n; first += kBatch) {
    const Index count = std::min(kBatch, n - first);
    const Tensor values = backbone.features(preprocessed(how, rgb + first * how.size(), count));
    std::ranges::copy(values.values<float>(), to + first * dimension);
    let_python_interrupt();
  }
  return result;
}

py::tuple input_shape(const LoadedBackbone& self) {
  const Preprocessing& how = self.backbone.preprocessing();
  return py::make_tuple(how.height, how.width, 3);
}

/// The docstring with the names of all networks.
std::string class_doc() {
  std::vector<std::string> names;
  for (const auto& kind : models::backbone_kinds()) names.push_back(kind.name);
  std::string doc = kClassDoc;
  const std::string placeholder = "{names}";
  return doc.replace(doc.find(placeholder), placeholder.size(), joined_with(", ", names));
}

}  // namespace

void bind_backbone(py::module_& module) {
  py::class_<LoadedBackbone>(module, "Backbone", class_doc().c_str())
      .def(py::init(&load), kInitDoc, py::arg("name"), py::arg("weights") = py::none(), py::arg("layer") = py::none(),
           py::arg("seed") = 0)
      .def("features", features, kFeaturesDoc, py::arg("images"))
      .def_property_readonly(
          "name", [](const LoadedBackbone& self) { return self.backbone.kind().name; }, "Name of the network.")
      .def_property_readonly(
          "layer", [](const LoadedBackbone& self) { return self.backbone.output_name(); }, "Name of the output layer.")
      .def_property_readonly(
          "dimension", [](const LoadedBackbone& self) { return self.backbone.dimension(); }, "Number of features D.")
      .def_property_readonly("input_shape", input_shape, "(H, W, 3) of an image.")
      .def_property_readonly(
          "unused_layers", [](const LoadedBackbone& self) { return self.unused_layers; },
          "Layers of the weights file that the network does not use, because they are above its output.")
      .def("__repr__", [](const LoadedBackbone& self) {
        return joined("<svnet.Backbone ", self.backbone.kind().name, ", layer ", self.backbone.output_name(), ", ",
                      self.backbone.dimension(), " features>");
      });
}

}  // namespace svnet::python
