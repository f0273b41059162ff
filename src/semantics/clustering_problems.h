#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"
#include "base/random.h"

namespace svnet {

struct ProblemOptions {
  Index min_categories = 3;
  Index max_categories = 0;  ///< 0: all that are not excluded; more than there are means all
  Index min_objects = 1;     ///< of each category
  Index max_objects = 0;     ///< 0: all of the category; more than it has means all
  std::vector<std::int64_t> excluded_categories{};
};

/// A clustering problem: items are objects in a pose, and the true clusters their categories. Make it with
/// ClusteringProblems::new_problem, so that drawing never allocates.
struct ClusteringProblem {
  Index categories = 0;
  std::vector<std::int32_t> poses;   ///< (items) numbers of poses
  std::vector<std::int32_t> labels;  ///< (items) in [0, categories), in order of first appearance
  std::vector<std::int32_t> rows;    ///< (items) views, after draw_views or a selector has filled them
  std::vector<std::int32_t> scratch_categories, scratch_objects;
};

/// The random clustering problems of PAPER.md section 4: the number of categories, which ones, and for each the number
/// of its objects, which ones, and a pose of each; then a view of each pose. Every draw is uniform. A problem is known
/// by its number and the seed alone. Immutable: any number of threads may draw.
class ClusteringProblems {
 public:
  /// The category, object and pose of every view: any numbers. Objects are unique within a category, poses within an
  /// object. Throws Error where the lengths differ, there is no view, an excluded category is unknown, or the options
  /// ask for more categories or objects than there are.
  ClusteringProblems(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                     std::span<const std::int64_t> pose, const ProblemOptions& options = {});

  ClusteringProblem new_problem() const;

  /// Problem `number`: draw_poses, then draw_views, from the stream Stream::problem.
  void draw(std::uint64_t seed, std::uint64_t number, ClusteringProblem& problem) const;
  /// Everything but the views: rows are left empty.
  void draw_poses(RandomStream& random, ClusteringProblem& problem) const;
  /// A uniform view of each pose.
  void draw_views(RandomStream& random, ClusteringProblem& problem) const;

  Index views() const { return pose_of_view_.size(); }
  Index poses() const { return pose_.size(); }
  Index max_items() const { return max_items_; }            ///< of any problem
  Index max_categories() const { return max_categories_; }  ///< of any problem

  /// Poses are numbered by category, object and pose, all in ascending order, those of excluded categories too.
  std::span<const std::int32_t> pose_of_view() const { return pose_of_view_; }
  /// Rows in ascending order.
  std::span<const std::int32_t> views_of_pose(Index pose) const {
    return std::span(views_.data() + pose_[pose].first, pose_[pose].count);
  }

  /// Views sorted by category, object, pose and row: the place of a view, the view at a place, its category's number in
  /// this order.
  std::int32_t place_of_view(Index view) const { return place_[view]; }
  std::int32_t view_at(Index place) const { return views_[place]; }
  std::int32_t category_of_view(Index view) const { return category_of_view_[view]; }

  /// The share of all problems that contain the view; 0 where its category is excluded.
  double inclusion_probability(Index view) const { return inclusion_[view]; }
  /// Whether a problem may hold the view together with another object of its category.
  bool may_have_partner(Index view) const { return may_have_partner_[view] != 0; }

 private:
  struct Range {
    std::int32_t first = 0, count = 0;
  };
  void index_views(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                   std::span<const std::int64_t> pose);
  void exclude(std::span<const std::int64_t> categories);
  void check_counts() const;
  void measure();
  Index most_objects(Index category) const;

  ProblemOptions options_;
  Index max_categories_ = 0, max_items_ = 0;
  std::vector<std::int64_t> category_name_;
  std::vector<Range> category_;                         // objects of each category
  std::vector<Range> object_;                           // poses of each object
  std::vector<Range> pose_;                             // entries of views_
  std::vector<std::int32_t> views_, pose_of_view_;      // rows sorted by pose; poses by row
  std::vector<std::int32_t> place_, category_of_view_;  // by row
  std::vector<std::int32_t> included_;                  // categories that are not excluded
  std::vector<double> inclusion_;                       // per view
  std::vector<std::uint8_t> may_have_partner_;          // per view
};

}  // namespace svnet
