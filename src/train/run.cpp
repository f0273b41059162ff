#include "train/run.h"

#include <algorithm>

#include "base/parallel.h"
#include "io/files/atomic_file.h"
#include "io/files/make_folder.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "models/registry.h"
#include "train/config/config_file.h"
#include "train/config/pipeline_name.h"
#include "train/dataset_rows.h"
#include "train/feature_extraction.h"
#include "train/random_problems.h"
#include "train/selectors.h"
#include "train/top_frames.h"
#include "train/trained_from.h"
#include "train/validation_categories.h"

namespace svnet::train {
using models::BackboneKind;

namespace fs = std::filesystem;

namespace {

void check_config(const Run& run) {
  const Config& config = run.config;
  const auto check_backbone = [&](const std::string& name, const std::string& layer) {
    const BackboneKind& kind = models::backbone_kind(name);
    output_layer(kind, kind.graph(kind.preprocessing.height, true), layer);
    check_weights(name, config.weights.folder);
  };
  for (const auto& name : scored_backbones(config.scores)) check_backbone(name, scored_layer(config.scores, name));
  if (frame::has_backbone(config.sv_net.frame)) check_backbone(config.sv_net.backbone, config.sv_net.layer);
  check(config.training.fine_tune == FineTune::none || run.inference.precision != runtime::Precision::int8,
        "training.fine_tune: with SVNET_PRECISION=int8 the backbone cannot be trained, because the ranges of its "
        "activations would change; choose none, or f32 or bf16");
  if (config.sv_net.frame == frame::FrameChoice::camera) {
    const BackboneKind& tuned = models::backbone_kind(config.sv_net.backbone);
    const Graph graph = tuned.graph(tuned.preprocessing.height, true);
    static_cast<void>(
        trained_from(config.training.fine_tune, tuned, graph, output_layer(tuned, graph, config.sv_net.layer)));
  }
  if (config.sv_net.depth != frame::DepthChoice::none)
    for (std::size_t pose = 0; pose < run.dataset.poses.size(); ++pose)
      static_cast<void>(top_depth_file(run.dataset, static_cast<Index>(pose)));
  for (const auto& name : config.evaluation.pipelines)
    check_backbone(parse_pipeline(name, "evaluation.pipelines").backbone, "");
  for (const SelectorKind* kind : selectors_of_table(config.evaluation.selectors, Split::training))
    check(kind->fewest <= config.evaluation.views, "evaluation.selectors: ", kind->name, " chooses ", kind->fewest,
          " views or more; set evaluation.views to that many");
  static_cast<void>(validation_categories(run.held_out, config));
  clustering_problems(run.dataset, run.held_out, config.scores);
  if (run.has_held_out_problems()) clustering_problems(run.dataset, run.training_categories(), config.scores);
}

}  // namespace

std::vector<bool> Run::training_categories() const {
  std::vector<bool> training = held_out;
  training.flip();
  return training;
}

bool Run::has_held_out_problems() const { return std::count(held_out.begin(), held_out.end(), true) >= 2; }

void Run::say(const std::string& line) const {
  if (messages.line) messages.line(line);
}

Run make_run(Config config, ViewDataset dataset, fs::path folder, const Messages& messages, Communicator& communicator,
             const InferenceOptions& inference) {
  std::vector<bool> held_out = named_categories(dataset, config.dataset.held_out, "dataset.held_out");
  const auto training = std::count(held_out.begin(), held_out.end(), false);
  check(training >= 2, "dataset.held_out: leaves ", training, " categories to train on, at least 2 are needed");
  Run run{.config = std::move(config),
          .dataset = std::move(dataset),
          .folder = std::move(folder),
          .held_out = std::move(held_out),
          .messages = messages,
          .communicator = communicator,
          .inference = inference};
  io::make_folder(run.folder);
  if (run.communicator.is_root())
    for (const std::string& note : io::dataset_notes(run.dataset, Parallel::shared())) run.say(note);
  run.dataset_fingerprint = io::fingerprint(run.dataset, Parallel::shared());
  run.say(joined("dataset ", run.config.dataset.root.string(), ": ", run.dataset.categories.size(), " categories, ",
                 run.dataset.objects.size(), " objects, ", run.dataset.poses.size(), " poses, ",
                 run.dataset.views.size(), " views"));
  check_config(run);
  return run;
}

Run with_config(const Run& run, Config config) {
  const Config::Dataset &before = run.config.dataset, &after = config.dataset;
  check(after.root == before.root && after.exif_orientation == before.exif_orientation &&
            after.held_out == before.held_out,
        "dataset: its keys cannot vary within a run folder");
  Run other = run;
  other.config = std::move(config);
  check_config(other);
  return other;
}

void write_config(const Run& run) {
  if (run.communicator.is_root()) io::write_atomically(run.folder / "config.yaml", to_yaml(run.config, run.folder));
}

}  // namespace svnet::train
