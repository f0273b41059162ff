#include "semantics/clustering_problems.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/error.h"

namespace svnet::semantics {
namespace {

/// Uniform in [lowest, highest].
Index between(RandomStream& random, Index lowest, Index highest) { return lowest + random.below(highest - lowest + 1); }

}  // namespace

ClusteringProblems::ClusteringProblems(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                                       std::span<const std::int64_t> pose, const ProblemOptions& options)
    : options_(options) {
  check(category.size() == object.size() && category.size() == pose.size(), "[problems] ", category.size(),
        " categories, ", object.size(), " objects and ", pose.size(), " poses; one of each per view is needed");
  check(!category.empty(), "[problems] there are no views");
  check(category.size() <= std::numeric_limits<std::int32_t>::max(), "[problems] ", category.size(),
        " views; at most 2147483647 are possible");
  index_views(category, object, pose);
  exclude(options_.excluded_categories);
  check_counts();
  weigh_views();
  measure();
}

void ClusteringProblems::index_views(std::span<const std::int64_t> category, std::span<const std::int64_t> object,
                                     std::span<const std::int64_t> pose) {
  views_.resize(category.size());
  std::iota(views_.begin(), views_.end(), 0);
  std::sort(views_.begin(), views_.end(), [&](std::int32_t a, std::int32_t b) {
    return std::tie(category[a], object[a], pose[a], a) < std::tie(category[b], object[b], pose[b], b);
  });
  pose_of_view_.resize(views_.size());
  place_.resize(views_.size());
  category_of_view_.resize(views_.size());
  const auto next = [](std::vector<Range>& ranges, std::size_t first) {
    ranges.push_back({static_cast<std::int32_t>(first), 0});
  };
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const std::int32_t view = views_[i], before = i == 0 ? view : views_[i - 1];
    const bool new_category = i == 0 || category[view] != category[before];
    const bool new_object = new_category || object[view] != object[before];
    const bool new_pose = new_object || pose[view] != pose[before];
    if (new_category) {
      category_name_.push_back(category[view]);
      next(category_, object_.size());
    }
    if (new_object) {
      next(object_, pose_.size());
      ++category_.back().count;
    }
    if (new_pose) {
      next(pose_, i);
      ++object_.back().count;
    }
    ++pose_.back().count;
    pose_of_view_[view] = pose_.size() - 1;
    category_of_view_[view] = category_.size() - 1;
    place_[view] = i;
  }
}

void ClusteringProblems::exclude(std::span<const std::int64_t> categories) {
  for (std::int64_t name : categories)
    check(std::binary_search(category_name_.begin(), category_name_.end(), name), "[problems] excluded category ", name,
          " has no views");
  for (std::size_t c = 0; c < category_.size(); ++c)
    if (std::find(categories.begin(), categories.end(), category_name_[c]) == categories.end()) included_.push_back(c);
  const Index all = included_.size();
  max_categories_ = options_.max_categories == 0 ? all : std::min(options_.max_categories, all);
}

Index ClusteringProblems::most_objects(Index category) const {
  const Index all = category_[category].count;
  return options_.max_objects == 0 ? all : std::min(options_.max_objects, all);
}

void ClusteringProblems::check_counts() const {
  const auto& o = options_;
  check(o.min_categories >= 1 && o.min_objects >= 1 && o.max_categories >= 0 && o.max_objects >= 0,
        "[problems] categories from ", o.min_categories, " to ", o.max_categories, " and objects from ", o.min_objects,
        " to ", o.max_objects, "; the least must be 1 or more, the most 0 (all) or more");
  check(o.max_categories == 0 || o.min_categories <= o.max_categories, "[problems] min_categories ", o.min_categories,
        " is above max_categories ", o.max_categories);
  check(o.max_objects == 0 || o.min_objects <= o.max_objects, "[problems] min_objects ", o.min_objects,
        " is above max_objects ", o.max_objects);
  check(o.min_categories <= std::ssize(included_), "[problems] ", included_.size(), " of ", category_.size(),
        " categories are left after excluding, min_categories is ", o.min_categories,
        "; exclude fewer or lower min_categories");
  for (std::int32_t c : included_)
    check(o.min_objects <= category_[c].count, "[problems] category ", category_name_[c], " has ", category_[c].count,
          " objects, min_objects is ", o.min_objects, "; exclude it or lower min_objects");
}

void ClusteringProblems::weigh_views() {
  const ViewWeights& weights = options_.view_weights;
  if (weights.empty()) return;
  check(weights.size() == views_.size(), "[problems] ", weights.size(), " weights of ", views_.size(), " views");
  for (std::size_t v = 0; v < weights.size(); ++v)
    check(std::isfinite(weights[v]) && weights[v] >= 0, "[problems] the weight of view ", v, " is ", weights[v],
          "; weights must be 0 or more");
  draw_below_.assign(views_.size(), 0);
  for (std::int32_t c : included_)
    for (Index o = category_[c].first; o < category_[c].first + category_[c].count; ++o)
      for (Index p = object_[o].first; p < object_[o].first + object_[o].count; ++p) {
        const auto views = views_of_pose(p);
        double highest = 0, sum = 0, so_far = 0;
        for (std::int32_t view : views) highest = std::max(highest, weights[view]);
        check(highest > 0, "[problems] all views of a pose have weight 0, view ", views.front(),
              " among them; one must be above 0, or exclude the category ", category_name_[c]);
        for (std::int32_t view : views) sum += weights[view] / highest;  // which cannot overflow
        std::uint64_t* below = draw_below_.data() + pose_[p].first;
        for (std::size_t i = 0; i < views.size(); ++i) {
          so_far += weights[views[i]] / highest;
          below[i] = static_cast<std::uint64_t>(std::llround(so_far / sum * 0x1p32));  // ends at 2^32: so_far == sum
        }
      }
}

/// The probability that the view at a place is drawn from its pose.
double ClusteringProblems::share_by_weight(Index place) const {
  const bool is_first = place == pose_[pose_of_view_[views_[place]]].first;
  return static_cast<double>(draw_below_[place] - (is_first ? 0 : draw_below_[place - 1])) * 0x1p-32;
}

void ClusteringProblems::measure() {
  std::vector<Index> most;
  for (std::int32_t c : included_) most.push_back(most_objects(c));
  std::sort(most.begin(), most.end(), std::greater<>());
  max_items_ = std::accumulate(most.begin(), most.begin() + max_categories_, Index{0});

  inclusion_.assign(views_.size(), 0.0);
  may_have_partner_.assign(views_.size(), 0);
  const double category_share = static_cast<double>(options_.min_categories + max_categories_) / 2 / included_.size();
  for (std::int32_t c : included_) {
    const double object_share = static_cast<double>(options_.min_objects + most_objects(c)) / 2 / category_[c].count;
    for (Index o = category_[c].first; o < category_[c].first + category_[c].count; ++o)
      for (Index p = object_[o].first; p < object_[o].first + object_[o].count; ++p)
        for (std::int32_t view : views_of_pose(p)) {
          const double pose_share = category_share * object_share / object_[o].count;
          inclusion_[view] =
              draw_below_.empty() ? pose_share / pose_[p].count : pose_share * share_by_weight(place_[view]);
          may_have_partner_[view] = most_objects(c) >= 2;
        }
  }
}

ClusteringProblem ClusteringProblems::new_problem() const {
  ClusteringProblem problem;
  problem.poses.reserve(max_items_);
  problem.labels.reserve(max_items_);
  problem.rows.reserve(max_items_);
  problem.scratch_categories.reserve(included_.size());
  Index objects = 0;
  for (std::int32_t c : included_) objects = std::max<Index>(objects, category_[c].count);
  problem.scratch_objects.reserve(objects);
  return problem;
}

void ClusteringProblems::draw(std::uint64_t seed, std::uint64_t number, ClusteringProblem& problem) const {
  RandomStream random(seed, Stream::problem, number);
  draw_poses(random, problem);
  draw_views(random, problem);
}

void ClusteringProblems::draw_poses(RandomStream& random, ClusteringProblem& problem) const {
  problem.poses.clear();
  problem.labels.clear();
  problem.rows.clear();
  auto& categories = problem.scratch_categories;
  auto& objects = problem.scratch_objects;
  categories.assign(included_.begin(), included_.end());
  problem.categories = between(random, options_.min_categories, max_categories_);
  draw_without_replacement(random, categories.data(), categories.size(), problem.categories);
  for (Index label = 0; label < problem.categories; ++label) {
    const Range all = category_[categories[label]];
    objects.resize(all.count);
    std::iota(objects.begin(), objects.end(), all.first);
    const Index count = between(random, options_.min_objects, most_objects(categories[label]));
    draw_without_replacement(random, objects.data(), all.count, count);
    for (Index i = 0; i < count; ++i) {
      const Range poses = object_[objects[i]];
      problem.poses.push_back(between(random, poses.first, poses.first + poses.count - 1));
      problem.labels.push_back(label);
    }
  }
}

void ClusteringProblems::draw_views(RandomStream& random, ClusteringProblem& problem) const {
  problem.rows.clear();
  for (std::int32_t pose : problem.poses) {
    const Range views = pose_[pose];
    if (draw_below_.empty()) {
      problem.rows.push_back(views_[between(random, views.first, views.first + views.count - 1)]);
      continue;
    }
    const auto first = draw_below_.begin() + views.first;
    const auto drawn = std::upper_bound(first, first + views.count, std::uint64_t{random.bits32()});
    problem.rows.push_back(views_[drawn - draw_below_.begin()]);
  }
}

void ClusteringProblems::draw_views(RandomStream& random, ClusteringProblem& problem, Index count) const {
  if (count == 1) return draw_views(random, problem);
  problem.rows.clear();
  auto& views = problem.scratch_objects;
  for (const std::int32_t pose : problem.poses) {
    const auto all = views_of_pose(pose);
    views.assign(all.begin(), all.end());
    const Index drawn = std::min(count, static_cast<Index>(views.size()));
    draw_without_replacement(random, views.data(), static_cast<Index>(views.size()), drawn);
    for (Index i = 0; i < count; ++i) problem.rows.push_back(views[static_cast<std::size_t>(i % drawn)]);
  }
}

}  // namespace svnet::semantics
