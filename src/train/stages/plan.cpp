#include "train/stages/plan.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "base/random.h"
#include "frame/turns.h"
#include "io/hdf5/hdf5_file.h"
#include "models/trained_graph.h"
#include "nn/ops/losses.h"
#include "semantics/semantic_scores.h"
#include "train/epoch_order.h"
#include "train/random_problems.h"
#include "train/stages/model.h"
#include "train/stages/options.h"
#include "train/stages/pair_scores.h"
#include "train/stages/trained_network.h"
#include "train/stages/wanted_scores.h"
#include "train/training_step.h"
#include "train/turned_features.h"
#include "train/validation_categories.h"

namespace svnet::train {
namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of a features or scores file. Returns "" if the file does not exist or cannot be read.
std::string stored_fingerprint(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return "";
  try {
    return io::Hdf5File::open(file).text_attribute("", "input_fingerprint");
  } catch (const Error&) {
    return "";  // the stage itself says what is wrong
  }
}

/// The first poses of the dataset, with about `views` views.
ViewDataset first_views(const ViewDataset& whole, Index views) {
  ViewDataset part = whole;
  const Index size = std::min(views, static_cast<Index>(whole.views.size()));
  part.views.resize(static_cast<std::size_t>(size));
  return part;
}

/// A view through the backbone.
double seconds_of_view(const Run& run, const BackboneWithOrigin& source) {
  constexpr Index kWarmUp = 2, kViews = 16;
  const FeaturesOrigin origin = features_origin(source, run.dataset_fingerprint);
  const auto extract = [&](Index views) {
    const ViewDataset part = first_views(run.dataset, views);
    extract_features(source.backbone, part, origin, {}, SingleProcess::shared());
    return static_cast<double>(part.views.size());
  };
  extract(kWarmUp);
  double views = 0;
  const double seconds = seconds_of([&] { views = extract(kViews); });
  return seconds / views;
}

PlannedStage features_of(const Run& run, FeaturesStage& features, const std::string& backbone,
                         const std::string& layer) {
  PlannedStage planned{.stage = "features of " + backbone, .work = joined(run.dataset.views.size(), " images")};
  planned.is_made =
      stored_fingerprint(features_file(run.folder, backbone, layer)) == features.fingerprint(backbone, layer);
  if (!planned.is_made)
    planned.seconds =
        seconds_of_view(run, features.backbone(backbone, layer)) * static_cast<double>(run.dataset.views.size());
  return planned;
}

PlannedStage turned_features_of(const Run& run, FeaturesStage& features) {
  const Config::SvNet& sv_net = run.config.sv_net;
  const Index images = static_cast<Index>(run.dataset.poses.size()) * frame::kTurns;
  PlannedStage planned{.stage = "turned features of " + sv_net.backbone, .work = joined(images, " images")};
  const BackboneWithOrigin& source = features.backbone(sv_net.backbone, sv_net.layer);
  planned.is_made = stored_fingerprint(turned_features_file(run.folder, sv_net.backbone, sv_net.layer)) ==
                    turned_features_origin(source, run.dataset_fingerprint).input_fingerprint;
  if (!planned.is_made) planned.seconds = seconds_of_view(run, source) * static_cast<double>(images);
  return planned;
}

/// Problems are solved on random features: how long they take hardly depends on these.
double seconds_of_problem(const Run& run, const semantics::ClusteringProblems& problems) {
  constexpr Index kDimension = 8;
  constexpr std::uint64_t kProblems = 1 << 14;
  std::vector<float> features(static_cast<std::size_t>(problems.views() * kDimension));
  RandomStream random(run.seed(), Stream::weights, 0);
  for (float& value : features) value = static_cast<float>(random.uniform());
  const semantics::DistanceMatrix distances =
      semantics::squared_distances(features.data(), problems.views(), kDimension, Parallel::shared());
  semantics::ScoreOptions options = score_options(run.config, kDimension);
  options.problems = kProblems;
  options.min_samples = 0;
  options.target_error = 0;
  return seconds_of([&] { semantics::semantic_scores(distances, problems, options, Parallel::shared()); }) /
         static_cast<double>(kProblems);
}

PlannedStage scores_of(const Run& run, FeaturesStage& features, bool model_is_made) {
  const Config::Scores& config = run.config.scores;
  const auto passes = static_cast<Index>(scored_backbones(config).size()) * (config.rounds + 1);
  Config::Scores drawn = config;
  drawn.min_categories = fewest_categories(run.held_out, config);
  const semantics::ClusteringProblems problems = clustering_problems(run.dataset, run.held_out, drawn);
  const std::uint64_t count = semantics::expected_problems(problems, score_options(run.config, 0));
  PlannedStage planned{.stage = "scores"};
  planned.work = count > 0 ? joined(count, " problems")
                           : joined("problems until every standard error is at most ", config.target_error);
  if (passes > 1) planned.work += joined(", ", passes, " times");
  // Scores of later rounds depend on models that do not exist yet.
  planned.is_made = model_is_made || (config.rounds == 0 && stored_fingerprint(run.folder / "scores.h5") ==
                                                                wanted_scores_fingerprint(run.config, features));
  if (!planned.is_made && count > 0)
    planned.seconds = seconds_of_problem(run, problems) * static_cast<double>(count) * static_cast<double>(passes);
  return planned;
}

PlannedStage pair_scores_of(const Run& run, bool model_is_made) {
  constexpr double kLonger = 1.7;  // a problem of pairs than one of views (docs/benchmarks.md)
  const Config config = config_of_pairs(run.config);
  const semantics::ViewSets pairs = pairs_of_views(run.dataset, run.training_categories(), run.seed());
  const std::uint64_t count =
      semantics::expected_problems(clustering_problems(run.dataset, pairs, config.scores), score_options(config, 0));
  const std::size_t passes = scored_backbones(config.scores).size();
  PlannedStage planned{.stage = "scores of pairs", .work = joined(pairs.count(), " pairs"), .is_made = model_is_made};
  if (count > 0) planned.work += joined(", ", count, " problems");
  if (passes > 1) planned.work += joined(", ", passes, " times");
  if (!model_is_made && count > 0)
    planned.seconds = kLonger * static_cast<double>(count * passes) *
                      seconds_of_problem(run, clustering_problems(run.dataset, run.held_out, config.scores));
  return planned;
}

Index training_examples(const Run& run) {
  const std::vector<bool> learnt = category_use(run.held_out, run.config).learnt;
  const auto learns = [&](const View& view) { return learnt[static_cast<std::size_t>(view.category)]; };
  return std::ranges::count_if(run.dataset.views, learns) * trained_orientations(run.config);
}

/// A step on zeros, after one that allocates.
double seconds_of_step(const Run& run, const models::Backbone& backbone, Index batch) {
  const Graph graph = trained_network(run.config, backbone);
  Parameters parameters =
      models::trained_parameters(graph, backbone.parameters(), camera_head(run.config, backbone), run.seed());
  const auto optimizer = make_optimizer(trainable(graph, parameters), trainer_options(run.config, "").optimizer);
  std::vector<Tensor> inputs;
  for (const NodeId input : graph.inputs()) {
    Shape shape = graph.node(input).shape;
    shape.insert(shape.begin(), batch);
    inputs.push_back(Tensor::zeros(shape));
  }
  const auto step = [&] {
    training_step(graph, parameters, *optimizer, inputs,
                  [&](const Tensor& score) {
                    return ops::mean_squared_error(score, Tensor::zeros({batch, 1}));
                  },
                  {.products = autograd::GradientMap::Products::keep,
                   .convolution = run.inference.convolution,
                   .communicator = &SingleProcess::shared()});
  };
  step();
  return seconds_of(step);
}

PlannedStage model_of(const Run& run, FeaturesStage& features, bool is_made) {
  const Config& config = run.config;
  PlannedStage planned{.stage = "SV-net",
                       .work = joined("frame ", name_of(config.sv_net.frame), ", head ", name_of(config.sv_net.head)),
                       .is_made = is_made};
  if (config.sv_net.frame != frame::FrameChoice::camera) return planned;
  const Index batches = batch_count(config.training.batch_size, training_examples(run));
  planned.work = joined(config.training.epochs, " epochs of ", batches, " steps");
  if (is_made) return planned;
  const models::Backbone& backbone = features.backbone(config.sv_net.backbone, config.sv_net.layer).backbone;
  planned.seconds = seconds_of_step(run, backbone, config.training.batch_size) *
                    static_cast<double>(batches * config.training.epochs);
  return planned;
}

}  // namespace

std::vector<PlannedStage> planned_stages(const Run& run, FeaturesStage& features) {
  const Config& config = run.config;
  std::set<std::pair<std::string, std::string>> wanted;  // backbones and layers
  for (const std::string& name : scored_backbones(config.scores))
    wanted.emplace(name, scored_layer(config.scores, name));
  if (config.sv_net.frame == frame::FrameChoice::camera && config.training.fine_tune == FineTune::none &&
      trained_orientations(config) == 1)
    wanted.emplace(config.sv_net.backbone, config.sv_net.layer);
  const bool model_is_made = model_is_current(run, features);
  std::vector<PlannedStage> stages;
  stages.reserve(wanted.size() + 4);
  for (const auto& [backbone, layer] : wanted) stages.push_back(features_of(run, features, backbone, layer));
  if (frame::has_turns(config.sv_net.frame)) stages.push_back(turned_features_of(run, features));
  stages.push_back(scores_of(run, features, model_is_made));
  if (config.sv_net.next_view != NextViewChoice::none) stages.push_back(pair_scores_of(run, model_is_made));
  stages.push_back(model_of(run, features, model_is_made));
  return stages;
}

}  // namespace svnet::train
