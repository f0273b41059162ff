#include "serve/model_summary.h"

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "frame/frame_words.h"
#include "image/image.h"

namespace svnet::serve {

nlohmann::ordered_json model_json(const Model& model, const Limits& limits) {
  using Json = nlohmann::ordered_json;
  const TrainedOn& on = model.trained_on;
  Json json{{"version", kVersion},
            {"uses_depth", model.depth != frame::DepthChoice::none},
            {"depth", name_of(model.depth)},
            {"frame", name_of(model.frame)},
            {"frame_meaning", frame::words_of(model.frame)},
            {"backbone", frame::has_backbone(model.frame) ? Json(model.backbone) : Json()},
            {"head_parameters", model.head.parameter_count()},
            {"trained_on", {{"categories", on.categories}, {"objects", on.objects}, {"top_views", on.top_views}}},
            {"fingerprint", model.input_fingerprint}};
  json["limits"] = {{"body_bytes", limits.body_bytes},
                    {"image_pixels", kMostPixels},
                    {"poses", limits.poses},
                    {"seconds", limits.seconds},
                    {"parallel", limits.parallel}};
  return json;
}

}  // namespace svnet::serve
