#include "sorting/simulation.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "semantics/dendrogram.h"
#include "semantics/group_count.h"
#include "semantics/view_fusion.h"
#include "sorting/bins.h"

namespace svnet::sorting {
namespace {

using semantics::Linkage;

/// Random views of each pose of a table, (poses, count): all different unless the pose has fewer.
std::vector<std::int32_t> random_views(const ViewDataset& dataset, const Table& table, Index count,
                                       RandomStream& random) {
  std::vector<std::int32_t> chosen, of_pose;
  for (const std::int32_t p : table.poses) {
    const ViewDataset::Pose& pose = dataset.poses[static_cast<std::size_t>(p)];
    of_pose.resize(static_cast<std::size_t>(pose.view_count));
    std::iota(of_pose.begin(), of_pose.end(), static_cast<std::int32_t>(pose.first_view));
    draw_without_replacement(random, of_pose.data(), pose.view_count, std::min(count, pose.view_count));
    for (Index i = 0; i < count; ++i) chosen.push_back(of_pose[static_cast<std::size_t>(i % pose.view_count)]);
  }
  return chosen;
}

class Robot {
 public:
  Robot(const ViewDataset& dataset, std::span<const float> features, const SimulationOptions& options)
      : dataset_(dataset),
        features_(features),
        dimension_(std::ssize(features) / std::ssize(dataset.views)),
        options_(options) {}

  Outcome sorted(const Table& table, const train::Selector& selector, Index number, Parallel& parallel) const {
    Outcome outcome;
    outcome.views = views_of(table, selector, number);
    outcome.bins = bins_of(outcome.views, selector.views, std::ssize(table.categories), parallel);
    outcome.wrong = in_wrong_bin(outcome.bins, table.truth);
    outcome.wrong_count = std::ranges::count(outcome.wrong, true);
    std::vector<view::CameraPose> poses;
    for (auto view = outcome.views.begin(); view != outcome.views.end(); view += selector.views) {
      poses.clear();
      for (Index i = 0; i < selector.views; ++i) {
        const View& seen = dataset_.views[static_cast<std::size_t>(view[i])];
        poses.push_back({static_cast<double>(seen.theta_deg), static_cast<double>(seen.phi_deg)});
      }
      outcome.camera += camera_work(poses, options_.time);
    }
    return outcome;
  }

 private:
  std::vector<std::int32_t> views_of(const Table& table, const train::Selector& selector, Index number) const {
    if (selector.view.empty()) {
      RandomStream random(options_.seed, Stream::selector, static_cast<std::uint64_t>(number));
      return random_views(dataset_, table, selector.views, random);
    }
    std::vector<std::int32_t> views;
    for (const std::int32_t pose : table.poses) {
      const auto first = selector.view.begin() + pose * selector.views;
      views.insert(views.end(), first, first + selector.views);
    }
    return views;
  }

  std::vector<std::int32_t> bins_of(const std::vector<std::int32_t>& views, Index views_of_object, Index categories,
                                    Parallel& parallel) const {
    std::vector<float> seen;
    for (const std::int32_t view : views) {
      const auto row =
          features_.subspan(static_cast<std::size_t>(view * dimension_), static_cast<std::size_t>(dimension_));
      seen.insert(seen.end(), row.begin(), row.end());
    }
    const std::vector<Index> counts(views.size() / static_cast<std::size_t>(views_of_object), views_of_object);
    const std::vector<float> fused = semantics::fused_views(semantics::ViewFusion::mean, seen, dimension_, counts);
    const auto distances = semantics::squared_distances(fused.data(), std::ssize(counts), dimension_, parallel);
    const semantics::Dendrogram history = semantics::dendrogram(Linkage::ward, distances);
    return semantics::cut(history, groups_of(history, distances, categories));
  }

  Index groups_of(const semantics::Dendrogram& history, const semantics::DistanceMatrix& distances,
                  Index categories) const {
    switch (options_.groups.kind) {
      case GroupRule::Kind::categories:
        return categories;
      case GroupRule::Kind::estimated:
        return semantics::group_count(semantics::GroupCount::height, Linkage::ward, history, distances);
      case GroupRule::Kind::fixed:
        return options_.groups.count;
    }
    fail("[simulation] no rule of groups has this number");
  }

  const ViewDataset& dataset_;
  std::span<const float> features_;
  Index dimension_;
  const SimulationOptions& options_;
};

}  // namespace

std::vector<SortedTable> simulate(const ViewDataset& dataset, std::span<const float> features,
                                  std::span<const train::Selector> selectors, const SimulationOptions& options,
                                  const Messages& messages, Parallel& parallel) {
  const Tables tables(dataset, options.objects);
  const bool fixed = options.groups.kind == GroupRule::Kind::fixed;
  check(!fixed || (options.groups.count >= 1 && options.groups.count <= options.objects), "cannot make ",
        options.groups.count, " groups of ", options.objects, " objects");
  const Robot robot(dataset, features, options);
  std::vector<SortedTable> sorted(static_cast<std::size_t>(options.tables));
  Progress progress(messages, "tables", options.tables);
  constexpr Index kBlock = 64;
  for (Index block = 0; block < options.tables; block += kBlock) {
    const Index size = std::min(kBlock, options.tables - block);
    parallel.for_chunks(size, 1, [&](Index begin, Index end, int) {
      for (Index number = block + begin; number < block + end; ++number) {
        SortedTable& result = sorted[static_cast<std::size_t>(number)];
        result.table = tables.draw(options.seed, number);
        for (const train::Selector& selector : selectors)
          result.outcomes.push_back(robot.sorted(result.table, selector, number, parallel));
      }
    });
    progress.update(block + size);
  }
  return sorted;
}

}  // namespace svnet::sorting
