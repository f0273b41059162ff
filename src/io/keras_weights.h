#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

/// Keras' own names, shapes and axis orders, float32.
struct KerasArray {
  std::string name;
  std::vector<Index> shape;
  std::vector<float> values;
};

struct KerasLayerWeights {
  std::string name;
  std::vector<KerasArray> arrays;
};

enum class KerasLayout {
  legacy,  // TensorFlow's and Keras' .h5, and Keras Applications' downloads
  keras3,  // .weights.h5
};

/// Which layout a weights file has. Throws Error if it is neither.
KerasLayout keras_layout(const std::filesystem::path& path);

/// The legacy layout, at the root or, in files that hold a whole model, in its group `model_weights`. Layers in the
/// order of the attribute `layer_names`, arrays in the order of each layer's `weight_names` (both may be split,
/// `layer_names0`, `layer_names1`, …); layers without weights have no arrays. Weights of the model itself, beside its
/// layers, come last as `top_level_model_weights`.
///
/// float16, float32 and float64 become float32. Throws Error that names file and dataset for values that are not
/// finite, missing datasets and damaged files.
std::vector<KerasLayerWeights> read_keras_weights(const std::filesystem::path& path);

/// One layer of the Keras 3 layout. It knows layers by class and by how many of the class came before in
/// `model.layers`.
struct Keras3LayerWeights {
  std::string path;        // below `layers`: "conv2d_1", or "functional/layers/conv2d_1" in a model inside the model
  std::string class_name;  // "conv2d"
  Index counter = 0;       // 1
  std::string layer_name;  // the layer's own name, where the file has it
  std::vector<KerasArray> arrays;
};

/// The Keras 3 layout, group `layers`. Layers in natural order of their paths, which is `model.layers` order within one
/// class but not between classes; arrays in numerical order, named "0", "1", …. Weights of the model itself come last,
/// with an empty path. The states of optimizers and of random generators are left alone. Values and errors as in
/// read_keras_weights.
std::vector<Keras3LayerWeights> read_keras3_weights(const std::filesystem::path& path);

}  // namespace svnet
