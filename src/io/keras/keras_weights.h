#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/index.h"
#include "io/hdf5/hdf5_file.h"

namespace svnet::io {

/// Name and shape of an array in a weights file, as Keras wrote them.
struct KerasArray {
  std::string name;
  std::vector<Index> shape;
  std::string dataset;  // the path of its HDF5 dataset
};

struct KerasLayer {
  std::string path;        // legacy: the layer's name, "vgg16/block1_conv1" in a nested model. Keras 3: its path below
                           // `layers`, "conv2d_1", or "functional/layers/conv2d_1" in a nested model
  std::string model;       // the nested model that holds the layer, "vgg16" or "functional"; "" for the model's own
  std::string class_name;  // Keras 3: "conv2d"
  Index counter = 0;       // Keras 3: 1 in "conv2d_1", the number of layers of the class before it in `model.layers`
  std::string layer_name;  // the layer's own name; empty if a Keras 3 file has none
  std::vector<KerasArray> arrays;
};

enum class KerasLayout {
  legacy,  // TensorFlow's and Keras' .h5, and Keras Applications' downloads
  keras3,  // .weights.h5
};

/// A weights file. Opening it reads the names and shapes; `values` reads one array, so that only the weights that are
/// used take memory.
///
/// Legacy layout: at the root or, in files of whole models, in the group `model_weights`. The layers have the order of
/// the attribute `layer_names`, the arrays that of each layer's `weight_names`. (Keras may split both: `layer_names0`,
/// `layer_names1`, ….) Layers without weights have no arrays. Weights of the model itself come last, as
/// `top_level_model_weights`. A model inside the model is one of its layers and lists the arrays of all layers that it
/// holds, the trainable ones first: they are put together by the layer in their names, in the order of its first array.
///
/// Keras 3 layout: in the group `layers`. The layers have the natural order of their paths; within a class that is the
/// order of `model.layers`, between classes it is not. The arrays are named "0", "1", …. Weights of the model itself
/// come last, with an empty path. The states of optimizers and random generators are ignored.
class KerasWeightsFile {
 public:
  /// Throws Error that names the file and the HDF5 dataset if the file has neither layout, lacks a dataset or is
  /// damaged.
  explicit KerasWeightsFile(const std::filesystem::path& path);

  const std::string& name() const { return file_.name(); }
  KerasLayout layout() const { return layout_; }
  const std::vector<KerasLayer>& layers() const { return layers_; }

  /// The values of an array; bfloat16, float16, float32 and float64 become float32. Throws Error that names the file
  /// and the HDF5 dataset if a value is not finite.
  std::vector<float> values(const KerasArray& array) const;

 private:
  Hdf5File file_;
  KerasLayout layout_;
  std::vector<KerasLayer> layers_{};
};

}  // namespace svnet::io
