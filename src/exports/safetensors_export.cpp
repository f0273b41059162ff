#include "exports/exports.h"
#include "io/files/atomic_file.h"
#include "io/models/model_file.h"
#include "predict/predictor.h"

namespace svnet::exports {
namespace {

/// The part of a model that its scores are compared on.
ModelPart compared_part(const Model& model) {
  return model.frame == frame::FrameChoice::camera ? ModelPart::all : ModelPart::head;
}

}  // namespace

Agreement export_safetensors(const Model& model, const std::filesystem::path& path, StoredPrecision precision) {
  Agreement result;
  io::write_atomically(path, [&](const std::filesystem::path& temporary) {
    Model rounded = model;
    rounded.precision = precision;
    io::write_model(temporary, rounded);
    const Model written = io::read_model(temporary);
    const ModelPart part = compared_part(model);
    if (part == ModelPart::all) {
      const predict::Predictor predictor(written);
      const auto scores = [&](const Sample& sample) {
        return predictor.scores(predictor.embed(sample.picture), sample.poses);
      };
      result = agreement(path.string(), model, part, scores, bound_of(precision));
      return;
    }
    const Inference head(written.head, written.head_parameters, written.head.output());
    const auto scores = [&](const Sample& sample) {
      const Tensor output = head.run({sample.pose_inputs});
      return std::vector<float>(output.data<float>(), output.data<float>() + output.size());
    };
    result = agreement(path.string(), model, part, scores, bound_of(precision));
  });
  return result;
}

}  // namespace svnet::exports
