#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"
#include "base/random.h"

namespace svnet::semantics {

/// (views) Numbers >= 0: within a pose, views are drawn in proportion to them. Empty: uniformly.
using ViewWeights = std::vector<double>;

struct ProblemOptions {
  Index min_categories = 3;
  Index max_categories = 0;  ///< 0 or too large: all categories that are not excluded
  Index min_objects = 1;     ///< per category
  Index max_objects = 0;     ///< per category; 0 or too large: all objects of the category
  std::vector<std::int64_t> excluded_categories{};
  ViewWeights view_weights{};
};

/// A clustering problem: its items are objects in a pose, its true clusters their categories. Requires: made by
/// ClusteringProblems::new_problem, so that drawing never allocates.
struct ClusteringProblem {
  Index categories = 0;
  std::vector<std::int32_t> poses;   ///< (items) indices of poses
  std::vector<std::int32_t> labels;  ///< (items) in [0, categories), in order of first appearance
  std::vector<std::int32_t> rows;    ///< (items) views; filled by draw_views or by a selector
  std::vector<std::int32_t> scratch_categories, scratch_objects;
};

/// The random clustering problems of PAPER.md section 4. A problem is drawn in this order: the number of categories;
/// the categories; for each, the number of its objects, the objects and a pose of each; then a view of each pose. Every
/// draw is uniform, but that of views if they have weights. Seed and index determine a problem; the weights change its
/// views, not its poses. Immutable, so any number of threads may draw.
class ClusteringProblems {
 public:
  /// category, object, pose: (views) any integers; objects are unique within a category, poses within an object. Throws
  /// Error if the lengths differ, there is no view, an excluded category is unknown, or the options ask for more
  /// categories or objects than there are; also if a weight is negative or not finite, or a pose that takes part has
  /// none above 0. Probabilities by weights are rounded to multiples of 2^-32.
  ClusteringProblems(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                     std::span<const std::int64_t> pose, const ProblemOptions& options = {});

  ClusteringProblem new_problem() const;

  /// Draws problem `number`: draw_poses, then draw_views, from Stream::problem.
  void draw(std::uint64_t seed, std::uint64_t number, ClusteringProblem& problem) const;
  /// Draws everything but the views; problem.rows is empty afterwards.
  void draw_poses(RandomStream& random, ClusteringProblem& problem) const;
  /// Draws a view of each pose of the problem.
  void draw_views(RandomStream& random, ClusteringProblem& problem) const;
  /// Draws `count` views of each pose, all different unless the pose has fewer: then they are repeated in turn.
  /// problem.rows (items, count). One view: as above; several are drawn uniformly.
  void draw_views(RandomStream& random, ClusteringProblem& problem, Index count) const;

  Index views() const { return pose_of_view_.size(); }
  Index poses() const { return pose_.size(); }
  Index max_items() const { return max_items_; }            ///< of any problem
  Index max_categories() const { return max_categories_; }  ///< of any problem

  /// The index of the pose of each view. Poses are sorted by category, object and pose; excluded categories included.
  std::span<const std::int32_t> pose_of_view() const { return pose_of_view_; }
  /// The views of a pose in ascending order.
  std::span<const std::int32_t> views_of_pose(Index pose) const {
    return std::span(views_.data() + pose_[pose].first, pose_[pose].count);
  }

  // Views sorted by category, object, pose and row: the place of a view in this order, the view at a place, and the
  // index of its category.
  std::int32_t place_of_view(Index view) const { return place_[view]; }
  std::int32_t view_at(Index place) const { return views_[place]; }
  std::int32_t category_of_view(Index view) const { return category_of_view_[view]; }

  /// The probability that a problem contains the view; 0 if its category is excluded or its weight is 0.
  double inclusion_probability(Index view) const { return inclusion_[view]; }
  /// Whether a problem may contain the view together with another object of its category.
  bool may_have_partner(Index view) const { return may_have_partner_[view] != 0; }

 private:
  struct Range {
    std::int32_t first = 0, count = 0;
  };
  void index_views(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                   std::span<const std::int64_t> pose);
  void exclude(std::span<const std::int64_t> categories);
  void check_counts() const;
  void weigh_views();
  void measure();
  double share_by_weight(Index place) const;
  Index most_objects(Index category) const;

  ProblemOptions options_;
  Index max_categories_ = 0, max_items_ = 0;
  std::vector<std::int64_t> category_name_;
  std::vector<Range> category_;                         // objects of each category
  std::vector<Range> object_;                           // poses of each object
  std::vector<Range> pose_;                             // range in views_ of each pose
  std::vector<std::int32_t> views_, pose_of_view_;      // views sorted by pose; pose per view
  std::vector<std::int32_t> place_, category_of_view_;  // per view
  // Per place; empty without weights. A view is drawn if a uniform 32-bit number is below its entry, and not below that
  // of the view before it in the pose.
  std::vector<std::uint64_t> draw_below_;
  std::vector<std::int32_t> included_;          // categories that are not excluded
  std::vector<double> inclusion_;               // per view
  std::vector<std::uint8_t> may_have_partner_;  // per view
};

}  // namespace svnet::semantics
