#pragma once
#include <string>
#include <vector>

#include "data/model.h"
#include "train/config/choices.h"
#include "train/network_head.h"
#include "train/ridge.h"
#include "train/within_pose.h"

namespace svnet::train {

/// A kind of head, and how well it orders the views of poses whose categories it was not fitted to.
struct TriedHead {
  HeadChoice kind;
  WithinPose within_pose;
};

/// A head on pose inputs: ridge_share · ridge regression + (1 - ridge_share) · the mean of the networks.
struct HeadFit {
  RidgeFit ridge;
  std::vector<Parameters> networks{};  ///< of models::pose_network
  double ridge_share = 1;
  std::vector<TriedHead> tried{};  ///< if the choice was HeadChoice::best
};

/// How many networks are averaged; each has another seed.
inline constexpr std::size_t kNetworks = 4;

/// Fits a head of a kind. With HeadChoice::best, each kind predicts the examples of the categories of each fold
/// (folds_of_categories) after a fit to the others, and the one with the highest mean of Spearman's rank correlation
/// within poses is fitted to all. Throws Error as fit_ridge does.
HeadFit fit_head(const PoseExamples& examples, const RidgeOptions& options, HeadChoice choice);

/// What moving from the top view to the best predicted view gains, in folds over categories as fit_head's, by heads of
/// the same kind fitted to the others. Not known if the examples do not say which views are top views, or for fewer
/// than three categories. `scores`: of each example, whose differences are the gains.
GainCalibration gain_of_left_out(const PoseExamples& examples, const std::vector<double>& scores,
                                 const RidgeOptions& options, const HeadFit& head);

/// The predicted centred score of each example. Only x and inputs of the examples count.
std::vector<double> predictions(const HeadFit& head, const PoseExamples& examples);

/// "ridge .255, network .244, both .261", Spearman's correlations.
std::string tried_text(const std::vector<TriedHead>& tried);

/// Puts a linear function, times `factor`, into the parameters of models::linear_head or of the linear part of a head.
void set_linear(Parameters& parameters, const RidgeFit& fit, double factor);

/// Puts the head's graph and parameters into the model.
void set_head(Model& model, const HeadFit& head);

}  // namespace svnet::train
