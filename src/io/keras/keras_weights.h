#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/index.h"
#include "io/hdf5/hdf5_file.h"

namespace svnet {

/// An array of a weights file, without its numbers. Keras' own names, shapes and axis orders.
struct KerasArray {
  std::string name;
  std::vector<Index> shape;
  std::string dataset;  // where it lies in the file
};

struct KerasLayer {
  std::string path;        // the legacy layout: the layer's name. Keras 3: its place below `layers`, "conv2d_1", or
                           // "functional/layers/conv2d_1" in a model inside the model
  std::string class_name;  // Keras 3: "conv2d"
  Index counter = 0;       // Keras 3: 1, how many of the class came before in `model.layers`
  std::string layer_name;  // Keras 3: the layer's own name, where the file has it
  std::vector<KerasArray> arrays;
};

enum class KerasLayout {
  legacy,  // TensorFlow's and Keras' .h5, and Keras Applications' downloads
  keras3,  // .weights.h5
};

/// A weights file whose layers are known at once and whose numbers are read array by array: of a large network, only
/// what is used need come into memory.
///
/// The legacy layout lies at the root or, in files that hold a whole model, in its group `model_weights`. Layers in the
/// order of the attribute `layer_names`, arrays in the order of each layer's `weight_names` (both may be split,
/// `layer_names0`, `layer_names1`, …); layers without weights have no arrays. Weights of the model itself, beside its
/// layers, come last as `top_level_model_weights`.
///
/// The Keras 3 layout lies in the group `layers`. Layers in natural order of their paths, which is `model.layers` order
/// within one class but not between classes; arrays in numerical order, named "0", "1", …. Weights of the model itself
/// come last, with an empty path. The states of optimizers and of random generators are left alone.
class KerasWeightsFile {
 public:
  /// Throws Error that names file and dataset for files of neither layout, missing datasets and damaged files.
  explicit KerasWeightsFile(const std::filesystem::path& path);

  const std::string& name() const { return file_.name(); }
  KerasLayout layout() const { return layout_; }
  const std::vector<KerasLayer>& layers() const { return layers_; }

  /// float16, float32 and float64 become float32. Throws Error that names file and dataset for values that are not
  /// finite.
  std::vector<float> values(const KerasArray& array) const;

 private:
  Hdf5File file_;
  KerasLayout layout_;
  std::vector<KerasLayer> layers_{};
};

}  // namespace svnet
