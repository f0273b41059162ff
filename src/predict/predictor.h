#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "image/depth_image.h"
#include "image/image.h"
#include "io/models/model_file.h"
#include "nn/runtime/inference.h"
#include "predict/gain.h"
#include "predict/next_head.h"
#include "predict/score_head.h"
#include "predict/view_choice.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// What a Predictor keeps between calls, so that later calls of the same sizes allocate nothing. One call at a time may
/// use it, and one Predictor only.
struct Workspace {
  ScoreWorkspace head{}, next{};
  Inference::Arena backbone{};
  Tensor images{};  ///< the input of the backbone
  ResizeBuffers resizing{};
};

/// A trained model for inference. A top image becomes features once; features and a camera pose become a score in
/// [0, 1]. In frames other than `camera` the features are those of frame/frame_inputs.h. Thread-safe.
class Predictor {
 public:
  /// Throws Error that names the file and says what is wrong.
  explicit Predictor(const std::filesystem::path& model_file, const InferenceOptions& options = {});
  explicit Predictor(const Model& model, const InferenceOptions& options = {});

  /// The number D of features: over all symmetries, or turns, of the top image that the model sees.
  Index feature_count() const { return head_.feature_count(); }

  /// Features (1, D) of a top image of any size. Throws Error for an image without pixels, if rgb does not have height
  /// x width x 3 elements, and if a feature is not finite.
  /// `depth` is the depth image of the top view, which only a model that uses_depth() reads and needs: throws Error
  /// without it.
  Tensor embed(const Image& top, const DepthImage* depth = nullptr) const;

  /// The same, written to `features`, which has feature_count() elements. In the frame `camera` nothing is allocated if
  /// the workspace has seen an image of that size; in the others the silhouette and the turned images are. On failure
  /// the features are undefined.
  void embed(const Image& top, const DepthImage* depth, std::span<float> features, Workspace& workspace) const;

  /// In one line for a log: frame, number of features, precision, and how often the backbone runs which kernel.
  std::string description() const;

  bool uses_depth() const { return depth_ != frame::DepthChoice::none; }

  /// ScoreHead::familiarity of features that embed has returned.
  Familiarity familiarity(const Tensor& features) const { return head_.familiarity(features); }

  /// expected_gain (gain.h) from predicted scores of the best pose and the top view.
  Gain gain(double best_score, double top_score) const {
    return expected_gain(gain_, centred_margin(best_score, top_score));
  }
  /// Whether gain() knows; otherwise it throws.
  bool knows_gain() const { return !gain_.residuals.empty(); }

  /// Whether next_scores() knows; otherwise it throws.
  bool knows_next_view() const { return next_.has_value(); }

  /// NextHead::scores of features that embed has returned, when views of the object were taken. Throws Error unless the
  /// features are feature_count() finite floats, for poses out of range, and without a taken view.
  std::vector<float> next_scores(const Tensor& features, std::span<const frame::TakenView> taken,
                                 std::span<const view::CameraPose> poses) const;
  void next_scores(std::span<const float> features, std::span<const frame::TakenView> taken,
                   std::span<const view::CameraPose> poses, std::span<float> scores, Workspace& workspace) const;

  /// ScoreHead::scores of features that embed has returned.
  std::vector<float> scores(const Tensor& features, std::span<const view::CameraPose> poses) const;
  void scores(std::span<const float> features, std::span<const view::CameraPose> poses, std::span<float> scores,
              Workspace& workspace) const;
  Familiarity familiarity(std::span<const float> features, Workspace& workspace) const;

 private:
  void write_embedding(const Image& top, std::span<float> features, Workspace& workspace) const;
  /// (kTurns, components)
  Tensor values_of_turns(const Image& top) const;

  frame::FrameChoice frame_;
  models::Preprocessing preprocessing_;
  int symmetries_;
  frame::DepthChoice depth_;
  GainCalibration gain_;
  std::optional<Inference> backbone_;  // of all frames but `axis`
  ScoreHead head_;
  std::optional<NextHead> next_;
};

}  // namespace svnet::predict
