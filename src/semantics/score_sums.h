#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"

namespace svnet::semantics {

/// The sums of the scores of the problems solved so far, per view. Scores are 64-bit fixed point with 32 binary places:
/// sums of up to kMostProblems scores fit, and the order of the additions does not change them. So any split of the
/// work between threads, processes and resumed runs gives the same bits.
struct ScoreSums {
  struct View {
    std::uint64_t count = 0;             ///< problems that contain the view
    std::uint64_t individual_count = 0;  ///< problems that give it an individual score: fewer with Singletons::skip
    std::uint64_t individual = 0;        ///< sum of the individual scores
    std::uint64_t individual_squared = 0;
    std::uint64_t global = 0;  ///< sum of the global scores
    // The individual scores in even-numbered problems only, for rank_stability.
    std::uint64_t even_count = 0;
    std::uint64_t even = 0;

    bool operator==(const View&) const = default;
  };
  static constexpr std::uint64_t kMostProblems = std::uint64_t{1} << 32;
  std::uint64_t problems = 0;  ///< number of problems added; in a whole run they are 0 to problems - 1
  std::vector<View> views;

  ScoreSums() = default;
  explicit ScoreSums(Index view_count) : views(view_count) {}
  bool operator==(const ScoreSums&) const = default;

  /// Converts a score in [0, 1] to fixed point, rounded to nearest.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): scores are not negative, and this runs for every item
  static std::uint64_t fixed(double score) { return static_cast<std::uint64_t>(score * 0x1p32 + 0.5); }

  /// All members of `views` as one array, view by view.
  static constexpr Index kValuesPerView = sizeof(View) / sizeof(std::uint64_t);
  std::span<std::uint64_t> values() {
    return {reinterpret_cast<std::uint64_t*>(views.data()), views.size() * kValuesPerView};
  }
  std::span<const std::uint64_t> values() const {
    return {reinterpret_cast<const std::uint64_t*>(views.data()), views.size() * kValuesPerView};
  }

  /// Adds the scores of problem `number`: of all of it, and of each item; NaN: none. `items` are their views.
  void add(std::span<const std::int32_t> items, std::uint64_t number, double global,
           std::span<const double> individual);

  /// Adds `other` and sets it to zero. Throws Error if it has another number of views.
  void add_and_clear(ScoreSums& other);
};

/// Mean scores per view. NaN if no problem gave the view a score; the standard error is NaN with fewer than two.
struct SemanticScores {
  std::vector<double> individual, global;
  std::vector<std::uint64_t> count;    ///< problems that contain the view
  std::vector<double> standard_error;  ///< of `individual`
  std::uint64_t problems = 0;
};

SemanticScores scores_from(const ScoreSums& sums);

/// The standard error of the individual score of one view; NaN for fewer than two scores.
double standard_error(const ScoreSums::View& sums);

/// How reliable the order of the views of each pose is: Kendall's tau between the orders by individual score in even
/// and in odd problems. 1: the halves agree on every pair of views; 0: they agree by chance. Returns, per view, the
/// value of its pose; NaN if the view has no score, or fewer than two views of the pose have scores in both halves.
std::vector<double> rank_stability(const ScoreSums& sums, std::span<const std::int32_t> pose_of_view);

/// Scales scores to [0, 1] among the views of each pose; 0.5 if they are all equal. NaN stays NaN and is ignored.
/// Throws Error if the lengths differ or a pose is negative.
std::vector<double> scaled_per_pose(std::span<const double> scores, std::span<const std::int32_t> pose_of_view);

}  // namespace svnet::semantics
