#include "models/registry.h"

#include "base/text.h"
#include "models/mobilenet.h"
#include "models/mobilenet_v2.h"
#include "models/tiny_xception.h"
#include "models/vgg.h"
#include "models/xception.h"

namespace svnet {

const std::vector<BackboneKind>& backbone_kinds() {
  static const Preprocessing tf{.mode = PixelMode::tf, .height = 224, .width = 224};
  static const Preprocessing caffe{.mode = PixelMode::caffe, .height = 224, .width = 224};
  static const std::vector<BackboneKind> kinds{
      {"vgg16",
       "block5_pool",
       "block4_pool",
       caffe,
       models::vgg16,
       {"vgg16_weights_tf_dim_ordering_tf_kernels_notop.h5", "vgg16_weights_tf_dim_ordering_tf_kernels.h5"}},
      {"vgg19",
       "block5_pool",
       "block4_pool",
       caffe,
       models::vgg19,
       {"vgg19_weights_tf_dim_ordering_tf_kernels_notop.h5", "vgg19_weights_tf_dim_ordering_tf_kernels.h5"}},
      {"xception",
       "avg_pool",
       "add_11",
       {.mode = PixelMode::tf, .height = 299, .width = 299},
       models::xception,
       {"xception_weights_tf_dim_ordering_tf_kernels_notop.h5", "xception_weights_tf_dim_ordering_tf_kernels.h5"}},
      {"mobilenet",
       "global_average_pooling2d",
       "conv_pw_12_relu",
       tf,
       models::mobilenet,
       {"mobilenet_1_0_224_tf_no_top.h5", "mobilenet_1_0_224_tf.h5"}},
      {"mobilenet_v2",
       "global_average_pooling2d",
       "block_15_add",
       tf,
       models::mobilenet_v2,
       {"mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224_no_top.h5",
        "mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224.h5"}},
      {"tiny_xception",
       "avg_pool",
       "block4_act",
       {.mode = PixelMode::tf, .height = 96, .width = 96},
       models::tiny_xception,
       {"tiny_xception.h5"}},
  };
  return kinds;
}

const BackboneKind& backbone_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& kind : backbone_kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  fail("[backbone] there is no backbone '", name, "'", suggestion(name, names));
}

NodeId output_layer(const BackboneKind& kind, const Graph& graph, const std::string& layer) {
  const bool pooled = layer.empty() || layer == "avg_pool" || layer == "global_average_pooling2d";
  return graph.find(pooled ? kind.pooled : layer);
}

}  // namespace svnet
