#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"

namespace svnet {

/// What the problems solved so far add up to, per view. Scores are in 64-bit fixed point with 32 binary places, so that
/// sums over kMostProblems fit and do not depend on the order of the additions: states of any parts of the work
/// (threads, ranks, sessions) merge into the same bits.
struct ScoreSums {
  struct View {
    std::uint64_t count = 0;             ///< problems that contain the view
    std::uint64_t individual_count = 0;  ///< those with an individual score: fewer under Singletons::skip
    std::uint64_t individual = 0;        ///< sum of the individual scores
    std::uint64_t individual_squared = 0;
    std::uint64_t global = 0;  ///< sum of the problems' scores
    // The individual scores of the problems with even numbers alone, for comparing the two halves.
    std::uint64_t even_count = 0;
    std::uint64_t even = 0;

    bool operator==(const View&) const = default;
  };
  static constexpr std::uint64_t kMostProblems = std::uint64_t{1} << 32;
  std::uint64_t problems = 0;  ///< numbers 0 to problems - 1 are in; in a part of the work, how many are
  std::vector<View> views;

  ScoreSums() = default;
  explicit ScoreSums(Index view_count) : views(view_count) {}
  bool operator==(const ScoreSums&) const = default;

  /// A score in [0, 1] in fixed point, rounded to nearest.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): scores are not negative, and this is asked for every item
  static std::uint64_t fixed(double score) { return static_cast<std::uint64_t>(score * 0x1p32 + 0.5); }

  /// Every number but `problems`, view by view.
  static constexpr Index kNumbersOfView = sizeof(View) / sizeof(std::uint64_t);
  std::span<std::uint64_t> numbers() {
    return {reinterpret_cast<std::uint64_t*>(views.data()), views.size() * kNumbersOfView};
  }
  std::span<const std::uint64_t> numbers() const {
    return {reinterpret_cast<const std::uint64_t*>(views.data()), views.size() * kNumbersOfView};
  }

  /// Adds the other state and makes it zero. Throws Error for a different number of views.
  void take(ScoreSums& other);
};

/// Means per view. NaN where a mean or an error has nothing to stand on: no problem, or fewer than two for the error.
struct SemanticScores {
  std::vector<double> individual, global;
  std::vector<std::uint64_t> count;    ///< problems that contain the view
  std::vector<double> standard_error;  ///< of the individual mean
  std::uint64_t problems = 0;
};

SemanticScores scores_from(const ScoreSums& sums);

/// Standard error of the individual mean of one view; NaN for fewer than two scores.
double standard_error(const ScoreSums::View& sums);

/// How well the order of the views of each pose is known: Kendall's tau between their orders by the individual scores
/// of the even-numbered problems and of the odd-numbered ones, per view that of its pose. 1: the halves agree on every
/// pair of views; 0: not more than by chance. NaN without a score in both halves, or without another view that has
/// them.
std::vector<double> rank_stability(const ScoreSums& sums, std::span<const std::int32_t> pose_of_view);

/// Scores scaled to [0, 1] among the views of each pose; 0.5 where they are all equal. NaN stays, and counts for
/// nothing. Throws Error where the lengths differ or a pose is negative.
std::vector<double> scaled_per_pose(std::span<const double> scores, std::span<const std::int32_t> pose_of_view);

}  // namespace svnet
