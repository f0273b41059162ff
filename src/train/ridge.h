#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "train/pose_examples.h"

namespace svnet::train {

struct RidgeOptions {
  /// Per input: whether it has the small penalty kSmallPenalty instead of the one that cross-validation chooses.
  std::vector<bool> small_penalty{};
  std::uint64_t seed = 0;  ///< of the folds
};

/// A linear function of the inputs.
struct RidgeFit {
  std::vector<double> weights;  ///< (inputs)
  double bias = 0;              ///< so that the mean prediction of the examples is 0
  double penalty = 0;           ///< of the inputs without the small one, relative to the mean of their squares
  double error = 0;             ///< mean squared error of the left-out categories, relative to predicting 0
};

/// The number of folds that choose the penalty, if there are as many categories.
inline constexpr std::size_t kRidgeFolds = 5;

/// The fold, from 0 on, of each category that occurs in the examples: about equally many in each of kRidgeFolds, or of
/// as many as there are categories.
std::map<std::int32_t, std::size_t> folds_of_categories(const PoseExamples& examples, std::uint64_t seed);

/// Penalties are relative to the mean of the inputs' squares, each kind of input to its own.
inline constexpr double kSmallPenalty = 0.01;
inline constexpr double kPenalties[] = {1, 10, 100, 1000};

/// Fits, in closed form, differences within poses: the weighted mean of each pose is subtracted from its inputs and
/// from y (fixed effects of poses), so what does not depend on the camera does not matter. The penalty is the one of
/// kPenalties with the smallest error in five folds over categories, or over as many as there are. Throws Error if
/// there are fewer than 2 categories or a value is not finite. Has the same bits for any number of threads.
RidgeFit fit_ridge(const PoseExamples& examples, const RidgeOptions& options);

}  // namespace svnet::train
