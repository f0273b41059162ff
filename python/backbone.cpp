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
namespace {

namespace py = pybind11;

constexpr Index kBatch = 32;  // images computed at once: bounds the memory

constexpr const char* kClassDoc =
    R"(A convolutional network, cut at the layer whose output are the features. Safe to share between threads.

Parameters
----------
name : one of {names}
weights : path of a Keras HDF5 weights file, legacy layout or Keras 3 .weights.h5, or of a .safetensors file that
    svnet-pretrain wrote; None: the built-in weights of tiny_xception, for others random numbers from the seed, and no
    top. The network has its top ("predictions") if the file has one.
layer : Keras name of the output layer; None: the pooled output, block5_pool of VGG, else global average pooling
    (also "avg_pool", "global_average_pooling2d")
seed : int from 0 to 2^64 - 1, used where there are no weights, given or built in

Raises
------
svnet.Error for unknown names, with the nearest one, and for files that cannot be read or hold other weights.
)";

constexpr const char* kInitDoc = R"(__init__(self, name, weights=None, layer=None, seed=0)
--

As the class says.
)";

constexpr const char* kFeaturesDoc = R"(features(self, images)
--

The features of pictures.

images : (N, H, W, 3) uint8, RGB, already at the input size (input_shape), not preprocessed; any strides.
Returns (N, D) float32, D = dimension; the layer's output (H', W', C) is flattened in that order.
Raises svnet.Error for another dtype or shape.
)";

struct LoadedBackbone {
  Backbone backbone;
  std::vector<std::string> unused_layers;

  /// What pybind11 calls for the `self` of an instance whose __init__ has not been called, or has failed: methods would
  /// get memory that holds no backbone. Hence made_of calls ::new.
  static void* operator new(std::size_t) {
    throw py::type_error("svnet.Backbone has no network yet; call svnet.Backbone(name, ...)");
  }
  static void operator delete(void* memory) { ::operator delete(memory); }
};

std::unique_ptr<LoadedBackbone> made_of(Backbone backbone, std::vector<std::string> unused_layers) {
  return std::unique_ptr<LoadedBackbone>(::new LoadedBackbone{std::move(backbone), std::move(unused_layers)});
}

std::unique_ptr<LoadedBackbone> load(const py::object& given_name, const py::object& given_weights,
                                     const py::object& given_layer, const py::object& given_seed) {
  const std::string name = text("Backbone", "name", given_name, "the name of a network");
  const std::string output =
      given_layer.is_none() ? "" : text("Backbone", "layer", given_layer, "the name of a layer, or None");
  const std::uint64_t seed = whole_number("Backbone", "seed", given_seed);
  if (given_weights.is_none()) {
    const Computing computing;
    if (auto built_in = built_in_backbone(name, output)) return made_of(std::move(built_in->backbone), {});
    return made_of(random_backbone(name, output, seed), {});
  }
  const std::string weights = path("Backbone", "weights", given_weights);
  const Computing computing;
  KerasLoadReport report;
  Backbone backbone = read_backbone(name, weights, output, &report);
  return made_of(std::move(backbone), std::move(report.unused));
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
  const Array<std::uint8_t> pictures = images("Backbone.features", given);
  check(pictures.shape(1) == how.height && pictures.shape(2) == how.width, "[Backbone.features] images are ",
        pictures.shape(1), "x", pictures.shape(2), ", ", backbone.kind().name, " takes ", how.height, "x", how.width,
        "; resize them first");
  const Index n = pictures.shape(0), dimension = backbone.dimension();
  py::array_t<float> result({n, dimension});
  const std::uint8_t* rgb = pictures.data();
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
  for (const auto& kind : backbone_kinds()) names.push_back(kind.name);
  std::string doc = kClassDoc;
  const std::string hole = "{names}";
  return doc.replace(doc.find(hole), hole.size(), joined_with(", ", names));
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
          "Layers of the weights file above the last one of the network.")
      .def("__repr__", [](const LoadedBackbone& self) {
        return joined("<svnet.Backbone ", self.backbone.kind().name, ", layer ", self.backbone.output_name(), ", ",
                      self.backbone.dimension(), " features>");
      });
}

}  // namespace svnet::python
