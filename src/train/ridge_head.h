#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "data/scores.h"
#include "data/view_dataset.h"
#include "frame/top_frame.h"
#include "train/config/choices.h"
#include "train/head_fit.h"

namespace svnet::train {

/// A linear model of scores in the frame `axis`.
struct RidgeHead {
  HeadFit fit;
  frame::DepthChoice depth = frame::DepthChoice::none;
};

/// Fits the scores of the views of `categories` that have one: each minus the mean of its pose, weighted as
/// score_weights (view_targets.h) says. `frames` are those of the dataset's poses. Throws Error as fit_ridge does.
RidgeHead fit_ridge_head(const ViewDataset& dataset, std::span<const frame::TopFrame> frames, const Scores& scores,
                         const std::vector<bool>& categories, Target target, frame::DepthChoice depth,
                         std::uint64_t seed, HeadChoice head = HeadChoice::ridge);

/// The predicted centred score of every view of the dataset.
std::vector<double> predictions(const RidgeHead& head, const ViewDataset& dataset,
                                std::span<const frame::TopFrame> frames);

/// The head as a model without a backbone. Its fingerprint stays empty.
Model model_of(const RidgeHead& head);

}  // namespace svnet::train
