#include "report/collect.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "frame/frame_words.h"
#include "io/files/atomic_file.h"
#include "io/views/features_file.h"
#include "report/feature_map.h"
#include "report/shown_poses.h"
#include "report/write_report.h"
#include "train/dataset_rows.h"
#include "train/view_targets.h"

namespace svnet::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMapped = 600;

std::vector<std::string> random_backbones(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("features-") && entry.path().extension() == ".h5")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> names;
  for (const fs::path& file : files)
    if (const FeaturesOrigin origin = io::read_features_origin(file); origin.weights_sha256.starts_with("random"))
      if (std::find(names.begin(), names.end(), origin.backbone) == names.end()) names.push_back(origin.backbone);
  return names;
}

/// The distribution of the scores of each category that has some.
std::vector<CategoryScores> category_scores(const ViewDataset& dataset, const std::vector<ViewPrediction>& predictions,
                                            const std::vector<ShownPose>& poses) {
  std::vector<std::vector<double>> values(dataset.categories.size());
  std::vector<bool> held_out(dataset.categories.size());
  for (std::size_t v = 0; v < predictions.size(); ++v) {
    const auto category = static_cast<std::size_t>(dataset.views[v].category);
    if (std::isfinite(predictions[v].score)) values[category].push_back(predictions[v].score);
    held_out[category] = predictions[v].held_out;
  }
  std::vector<CategoryScores> all;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (values[c].empty()) continue;
    double chosen = 0, top = 0, count = 0;
    for (const ShownPose& pose : poses)
      if (pose.category == dataset.categories[c] && std::isfinite(pose.views[pose.chosen].score) &&
          std::isfinite(pose.views[pose.top].score)) {
        chosen += pose.views[pose.chosen].score;
        top += pose.views[pose.top].score;
        ++count;
      }
    all.push_back(
        {held_out[c],
         {.label = dataset.categories[c], .box = box_of(values[c]), .chosen = chosen / count, .top = top / count}});
  }
  return all;
}

std::optional<FeatureMap> map_of(const train::Config& config, const ViewDataset& dataset, const fs::path& folder,
                                 const std::vector<ShownPose>& poses, const std::vector<Index>& of_dataset,
                                 Parallel& parallel) {
  if (poses.size() < 3) return {};
  const std::string backbone = train::scored_backbones(config.scores).front();
  const fs::path file = train::features_file(folder, backbone, train::scored_layer(config.scores, backbone));
  check(fs::exists(file), file.string(), ": no such file; run svnet-eval, or svnet-crossval, on this run again");
  const Features features = io::read_features(file);
  train::check_rows(dataset, features.paths, file.string());
  MappedViews views;
  const std::size_t count = std::min(poses.size(), kMostMapped);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = i * poses.size() / count;
    const Index first = dataset.poses[static_cast<std::size_t>(of_dataset[p])].first_view;
    views.top.push_back(first + static_cast<Index>(poses[p].top));
    views.chosen.push_back(first + static_cast<Index>(poses[p].chosen));
  }
  return feature_map(dataset, features, views, static_cast<std::uint64_t>(config.seed), parallel);
}

std::string head_words(const train::Config& config) {
  if (config.sv_net.frame == frame::FrameChoice::camera)
    return joined("network of width ", config.sv_net.width, " on ", config.sv_net.backbone, ", ",
                  config.training.epochs, " epochs");
  std::string text = name_of(config.sv_net.head);
  if (frame::has_backbone(config.sv_net.frame)) text += " on " + config.sv_net.backbone;
  return text;
}

}  // namespace

std::vector<Setting> settings_of(const train::Config& config, const ViewDataset& dataset) {
  const train::Config::Scores& scores = config.scores;
  std::vector<Setting> settings{
      {"Dataset",
       joined(config.dataset.root.filename().string(), ": ", dataset.categories.size(), " categories, ",
              dataset.objects.size(), " objects, ", dataset.poses.size(), " poses, ", dataset.views.size(), " views")}};
  if (!config.dataset.held_out.empty()) settings.push_back({"Held out", joined_with(", ", config.dataset.held_out)});
  settings.push_back({"Frame", joined(name_of(config.sv_net.frame), ": ", frame::words_of(config.sv_net.frame))});
  if (frame::has_axis(config.sv_net.frame))
    settings.push_back({"Depth", config.sv_net.depth == frame::DepthChoice::none
                                     ? "none: images alone"
                                     : "heights: how the object stands above the table"});
  settings.push_back({"Head", head_words(config)});
  settings.push_back({"Scores", joined("clusters of features of ", joined_with(", ", train::scored_backbones(scores)),
                                       " by ", name_of(scores.clustering), "; ", scores.rounds, " on-policy rounds")});
  settings.push_back({"Target", joined(name_of(config.sv_net.target), " scores")});
  settings.push_back({"Seed", joined(config.seed)});
  return settings;
}

std::vector<ViewPrediction> predictions_of(const train::Run& run, std::span<const double> predicted,
                                           const Scores& scores, const semantics::SemanticScores* held_out) {
  const auto target = run.config.sv_net.target;
  const std::vector<double>& known = target_scores(scores, target);
  std::vector<ViewPrediction> predictions;
  for (std::size_t v = 0; v < run.dataset.views.size(); ++v) {
    ViewPrediction view{.predicted = predicted[v],
                        .score = known[v],
                        .standard_error = scores.standard_error[v],
                        .held_out = run.held_out[static_cast<std::size_t>(run.dataset.views[v].category)]};
    if (view.held_out) {
      view.score = held_out != nullptr ? target_scores(*held_out, target)[v] : std::nan("");
      view.standard_error = held_out != nullptr ? held_out->standard_error[v] : std::nan("");
    }
    predictions.push_back(view);
  }
  return predictions;
}

std::vector<ViewPrediction> predictions_of(const train::Run& run, const train::CrossValidation& validation) {
  const std::vector<double>& known = target_scores(validation.scores, run.config.sv_net.target);
  std::vector<ViewPrediction> predictions;
  for (std::size_t v = 0; v < known.size(); ++v)
    predictions.push_back({.predicted = validation.predicted[v],
                           .score = known[v],
                           .standard_error = validation.scores.standard_error[v],
                           .held_out = std::isfinite(validation.predicted[v])});
  return predictions;
}

RunReport collect(const train::Config& config, const ViewDataset& dataset, const fs::path& folder, Parallel& parallel) {
  RunReport report;
  report.name = fs::weakly_canonical(folder).filename().string();
  report.tables = read_tables(folder);
  report.cross_validation =
      std::none_of(report.tables.begin(), report.tables.end(), [](const Table& table) { return !table.held_out; });
  const bool fitted = config.sv_net.frame != frame::FrameChoice::camera;
  report.closed_form = fitted && config.sv_net.head == train::HeadChoice::ridge;
  report.target = name_of(config.sv_net.target);
  report.random_backbones = random_backbones(folder);
  report.settings = settings_of(config, dataset);
  if (report.cross_validation) report.folds = read_folds(folder);

  const std::vector<ViewPrediction> predictions = read_predictions(folder, dataset);
  std::vector<Index> of_dataset;
  report.poses = shown_poses(dataset, predictions, of_dataset);
  if (report.tables.empty() || !report.tables.front().held_out) report.poses.clear();
  std::vector<bool> held_out(dataset.categories.size());
  for (std::size_t v = 0; v < predictions.size(); ++v)
    held_out[static_cast<std::size_t>(dataset.views[v].category)] = predictions[v].held_out;
  report.held_out_categories = std::count(held_out.begin(), held_out.end(), true);
  report.training_categories = static_cast<Index>(held_out.size()) - report.held_out_categories;

  report.map = map_of(config, dataset, folder, report.poses, of_dataset, parallel);
  add_pictures(dataset, of_dataset, config.sv_net.depth, report.poses, parallel);
  report.scores = category_scores(dataset, predictions, report.poses);
  if (!report.cross_validation) report.curves = read_curves(folder);
  report.times = train::read_stage_times(folder);
  return report;
}

fs::path write_report(const train::Config& config, const ViewDataset& dataset, const fs::path& folder,
                      Parallel& parallel, const fs::path& file) {
  fs::path path = file.empty() ? folder / "report.html" : file;
  io::write_atomically(path, report_html(collect(config, dataset, folder, parallel)));
  return path;
}

}  // namespace svnet::report
