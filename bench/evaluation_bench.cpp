// evaluation/10000: an evaluation table of 10000 problems of the paper's size, with three pipelines (Ward, k-means,
// Ward on other features) and three selectors.
#include <benchmark/benchmark.h>

#include "train/evaluation.h"

namespace svnet {
using semantics::DistanceMatrix;

namespace {

ViewDataset paper_dataset() {
  ViewDataset dataset;
  for (Index c = 0; c < 24; ++c) {
    dataset.categories.push_back(std::to_string(c));
    for (Index o = 0; o < 5; ++o) {
      const auto object = static_cast<Index>(dataset.objects.size());
      dataset.objects.push_back({std::to_string(o), c});
      for (Index p = 0; p < 3; ++p) {
        const auto pose = static_cast<Index>(dataset.poses.size()), first = static_cast<Index>(dataset.views.size());
        dataset.poses.push_back({std::to_string(p), object, c, first, 21, first});
        for (Index v = 0; v < 21; ++v) dataset.views.push_back({"", c, object, pose, 45, 0, v == 0});
      }
    }
  }
  return dataset;
}

DistanceMatrix random_distances(const ViewDataset& dataset, std::uint64_t seed) {
  constexpr Index kDimension = 64;
  std::vector<float> features;
  for (const View& view : dataset.views) {
    RandomStream centre(seed, Stream::shuffle, static_cast<std::uint64_t>(view.category));
    RandomStream noise(seed, Stream::weights, static_cast<std::uint64_t>(features.size()));
    for (Index d = 0; d < kDimension; ++d)
      features.push_back(static_cast<float>(centre.normal() + 1.5 * noise.normal()));
  }
  return semantics::squared_distances(features.data(), static_cast<Index>(dataset.views.size()), kDimension,
                                      Parallel::shared());
}

void evaluation(benchmark::State& state) {
  const ViewDataset dataset = paper_dataset();
  std::vector<std::int64_t> category, object, pose;
  std::vector<double> scores;
  for (const View& view : dataset.views) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
    scores.push_back(static_cast<double>(scores.size() % 17) / 17);
  }
  const DistanceMatrix first = random_distances(dataset, 1), second = random_distances(dataset, 2);
  const semantics::ClusteringProblems problems(category, object, pose);
  const semantics::ClusteringOptions ward{.dimension = 2048},
      kmeans{.method = semantics::Clustering::kmeans, .dimension = 2048};
  const train::EvaluationOptions options{.problems = static_cast<std::uint64_t>(state.range(0))};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        evaluate(
            dataset,
            {{problems,
              {{"top", train::top_views(dataset)}, {"rand", {}}, {"opt_ind", train::best_views(dataset, scores)}}}},
            {{"a_ward", &first, ward}, {"a_kmeans", &first, kmeans}, {"b_ward", &second, ward}}, options,
            Parallel::shared(), {}, "")
            .problems);
}
BENCHMARK(evaluation)->Arg(10000)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace svnet
