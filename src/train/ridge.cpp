#include "train/ridge.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "train/pose_examples.h"
#include "train/shuffled.h"

namespace svnet::train {
namespace {

/// The sums that a least-squares fit needs: of x xᵀ, of x y and of y².
struct Moments {
  Eigen::MatrixXd xx;
  Eigen::VectorXd xy;
  double yy = 0;

  explicit Moments(Index inputs) : xx(Eigen::MatrixXd::Zero(inputs, inputs)), xy(Eigen::VectorXd::Zero(inputs)) {}
  void add(const Moments& other, double sign = 1) {
    xx += sign * other.xx;
    xy += sign * other.xy;
    yy += sign * other.yy;
  }
  double squared_error(const Eigen::VectorXd& weights) const {
    return yy - 2 * weights.dot(xy) + weights.dot(xx * weights);
  }
};

/// The moments of each category, with the weighted mean of each pose subtracted.
std::map<std::int32_t, Moments> moments_by_category(const PoseExamples& e) {
  std::map<std::int32_t, Moments> moments;
  const auto inputs = static_cast<std::size_t>(e.inputs);
  for (const auto& [begin, end] : pose_ranges(e.pose)) {
    Eigen::VectorXd mean_x = Eigen::VectorXd::Zero(e.inputs);
    double mean_y = 0, sum = 0;
    for (std::size_t i = begin; i < end; ++i) {
      mean_x += e.weight[i] * Eigen::Map<const Eigen::VectorXd>(e.x.data() + i * inputs, e.inputs);
      mean_y += e.weight[i] * e.y[i];
      sum += e.weight[i];
    }
    mean_x /= sum;
    mean_y /= sum;
    Moments& m = moments.try_emplace(e.category[begin], e.inputs).first->second;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(e.x.data() + i * inputs, e.inputs) - mean_x;
      const double y = e.y[i] - mean_y;
      m.xx += e.weight[i] * x * x.transpose();
      m.xy += e.weight[i] * y * x;
      m.yy += e.weight[i] * y * y;
    }
  }
  return moments;
}

/// The mean of the diagonal over the inputs with, or without, the small penalty.
double mean_square(const Moments& m, const std::vector<bool>& small_penalty, bool small) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < small_penalty.size(); ++i)
    if (small_penalty[i] == small) {
      sum += m.xx(static_cast<Index>(i), static_cast<Index>(i));
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

Eigen::VectorXd solved(const Moments& m, const std::vector<bool>& small_penalty, double penalty) {
  const double small = kSmallPenalty * mean_square(m, small_penalty, true);
  const double other = penalty * mean_square(m, small_penalty, false);
  Eigen::MatrixXd a = m.xx;
  for (std::size_t i = 0; i < small_penalty.size(); ++i)
    a(static_cast<Index>(i), static_cast<Index>(i)) +=
        std::max(small_penalty[i] ? small : other, std::numeric_limits<double>::min());
  return a.ldlt().solve(m.xy);
}

void check_examples(const PoseExamples& e) {
  const std::size_t count = e.y.size();
  check(e.x.size() == count * static_cast<std::size_t>(e.inputs) && e.weight.size() == count &&
            e.pose.size() == count && e.category.size() == count,
        "[ridge] the columns have different lengths");
  const auto finite = [](double value) { return std::isfinite(value); };
  check(std::all_of(e.x.begin(), e.x.end(), finite) && std::all_of(e.y.begin(), e.y.end(), finite),
        "[ridge] an input or a score is not a finite number");
}

}  // namespace

std::map<std::int32_t, std::size_t> folds_of_categories(const PoseExamples& examples, std::uint64_t seed) {
  const std::set<std::int32_t> distinct(examples.category.begin(), examples.category.end());
  RandomStream random(seed, Stream::cross_validation);
  const auto order = shuffled(std::vector<std::int32_t>(distinct.begin(), distinct.end()), random);
  std::map<std::int32_t, std::size_t> folds;
  for (std::size_t i = 0; i < order.size(); ++i) folds[order[i]] = i % std::min(kRidgeFolds, order.size());
  return folds;
}

RidgeFit fit_ridge(const PoseExamples& examples, const RidgeOptions& options) {
  check_examples(examples);
  const auto by_category = moments_by_category(examples);
  check(by_category.size() >= 2, "[ridge] needs at least 2 categories with scores, there are ", by_category.size());
  const auto fold = folds_of_categories(examples, options.seed);

  Moments all(examples.inputs);
  std::vector<Moments> left_out(std::min(kRidgeFolds, by_category.size()), Moments(examples.inputs));
  for (const auto& [category, moments] : by_category) {
    all.add(moments);
    left_out[fold.at(category)].add(moments);
  }

  RidgeFit fit;
  double least = std::numeric_limits<double>::infinity();
  for (const double penalty : kPenalties) {
    double error = 0;
    for (const Moments& part : left_out) {
      Moments rest = all;
      rest.add(part, -1);
      error += part.squared_error(solved(rest, options.small_penalty, penalty));
    }
    if (error < least) {
      least = error;
      fit.penalty = penalty;
    }
  }
  fit.error = all.yy > 0 ? least / all.yy : 1;
  const Eigen::VectorXd weights = solved(all, options.small_penalty, fit.penalty);
  fit.weights.assign(weights.begin(), weights.end());
  const auto inputs = static_cast<std::size_t>(examples.inputs);
  for (std::size_t i = 0; i < examples.y.size(); ++i)
    fit.bias -= weights.dot(Eigen::Map<const Eigen::VectorXd>(examples.x.data() + i * inputs, examples.inputs)) /
                static_cast<double>(examples.y.size());
  return fit;
}

}  // namespace svnet::train
