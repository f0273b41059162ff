#pragma once
#include <span>
#include <vector>

#include "data/model.h"
#include "data/scores.h"
#include "data/view_dataset.h"
#include "frame/next_inputs.h"
#include "semantics/view_sets.h"
#include "train/ridge.h"

namespace svnet::train {

/// Views of a dataset beside views that were taken of the same pose.
struct ViewsBeside {
  const ViewDataset& dataset;
  frame::FrameSpec spec;
  std::vector<float> features;               ///< (poses, D), those of frame/frame_inputs.h
  std::span<const frame::ViewShape> shapes;  ///< of every view's picture
};

/// Fits the scores of pairs of views: each pair is two examples, of which either view was taken first and the other is
/// the candidate. What is learned are differences between the candidates beside one taken view, weighted as
/// score_weights (view_targets.h) says. `scores`: of each pair. Throws Error as fit_ridge does.
RidgeFit fit_next_head(const ViewsBeside& views, const semantics::ViewSets& pairs, const Scores& scores,
                       std::uint64_t seed);

/// Puts the head into the model.
void set_next_head(Model& model, const RidgeFit& fit);

}  // namespace svnet::train
