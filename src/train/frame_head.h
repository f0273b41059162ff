#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "data/scores.h"
#include "data/view_dataset.h"
#include "frame/frame_inputs.h"
#include "train/config/choices.h"
#include "train/head_fit.h"

namespace svnet::train {

/// A linear model of scores in a frame other than `camera`.
struct FrameHead {
  HeadFit fit;
  frame::FrameSpec spec;
  frame::SeenShapes seen;  ///< of the top views of the training categories
  GainCalibration gain{};
};

/// Fits the scores of the views of `categories` that have one: each minus the mean of its pose, weighted as
/// score_weights (view_targets.h) says. `features` are those of frame/frame_inputs.h of the dataset's poses, (poses,
/// D). `gains`: the scores whose differences are gains of moving the camera; nullptr: gains stay unknown. Throws Error
/// as fit_ridge does.
FrameHead fit_frame_head(const ViewDataset& dataset, std::span<const float> features, const Scores& scores,
                         const std::vector<bool>& categories, Target target, const frame::FrameSpec& spec,
                         std::uint64_t seed, HeadChoice head = HeadChoice::ridge, const Scores* gains = nullptr);

/// The predicted centred score of every view of the dataset.
std::vector<double> predictions(const FrameHead& head, const ViewDataset& dataset, std::span<const float> features);

/// Puts the head, what it has seen and what it gains into the model.
void set_frame_head(Model& model, const FrameHead& head);

/// The head as a model without a backbone. Its fingerprint stays empty.
Model model_of(const FrameHead& head);

}  // namespace svnet::train
