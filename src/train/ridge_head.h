#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "data/scores.h"
#include "data/view_dataset.h"
#include "frame/frame_inputs.h"
#include "train/config/choices.h"
#include "train/ridge.h"

namespace svnet::train {

/// A linear model of scores in a frame other than `camera`.
struct RidgeHead {
  RidgeFit fit;
  frame::FrameSpec spec;
};

/// Fits the scores of the views of `categories` that have one: each minus the mean of its pose, weighted by s² / (s² +
/// e²), where s is the standard deviation of such differences and e the standard error of the score, the largest one if
/// it is not known. `features` are those of frame/frame_inputs.h of the dataset's poses, (poses, D). Throws Error as
/// fit_ridge does.
RidgeHead fit_ridge_head(const ViewDataset& dataset, std::span<const float> features, const Scores& scores,
                         const std::vector<bool>& categories, Target target, const frame::FrameSpec& spec,
                         std::uint64_t seed);

/// The predicted centred score of every view of the dataset.
std::vector<double> predictions(const RidgeHead& head, const ViewDataset& dataset, std::span<const float> features);

/// The head as a model without a backbone. Its fingerprint stays empty.
Model model_of(const RidgeHead& head);

}  // namespace svnet::train
