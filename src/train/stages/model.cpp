#include "train/stages/model.h"

#include <memory>
#include <optional>
#include <set>

#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/models/checkpoint.h"
#include "io/views/scores_file.h"
#include "models/trained_graph.h"
#include "train/config/fingerprint.h"
#include "train/epoch_order.h"
#include "train/frame_head.h"
#include "train/next_head.h"
#include "train/stages/options.h"
#include "train/stages/pair_scores.h"
#include "train/stages/reuse_or_make.h"
#include "train/stages/top_features.h"
#include "train/stages/trained_network.h"
#include "train/stages/wanted_scores.h"
#include "train/top_frames.h"
#include "train/trainer.h"
#include "train/training_events.h"
#include "train/turned_projection.h"
#include "train/validation_categories.h"
#include "view/symmetry.h"

namespace svnet::train {
using frame::FrameChoice;
using io::Checkpoint;
using models::Backbone;

namespace {

/// The fingerprint of the model that this configuration leads to.
std::string wanted_fingerprint(const Run& run, FeaturesStage& features) {
  const Config& config = run.config;
  const std::string scores = wanted_scores_fingerprint(config, features);
  const Config::SvNet& sv_net = config.sv_net;
  const auto turned = [&] { return features.turned_fingerprint(sv_net.backbone, sv_net.layer); };
  const auto axis = [&] { return train::fingerprint(features.frames(sv_net.depth)); };
  switch (sv_net.frame) {
    case FrameChoice::camera:
      return model_fingerprint(features.fingerprint(sv_net.backbone, sv_net.layer), scores, config);
    case FrameChoice::axis:
      return model_fingerprint(axis(), scores, config);
    case FrameChoice::turned:
      return model_fingerprint(turned(), scores, config);
    case FrameChoice::turned_axis:
      return model_fingerprint(turned() + " " + axis(), scores, config);
  }
  fail("[model] there is no such frame");
}

/// The model before training: its head has no parameters yet.
Model untrained_model(const Config& config, const Backbone& backbone, const std::string& fingerprint) {
  return {.backbone = backbone.kind().name,
          .backbone_output = backbone.output_name(),
          .preprocessing = backbone.preprocessing(),
          .backbone_graph = backbone.graph(),
          .backbone_parameters = backbone.parameters(),
          .backbone_ranges = backbone.network().options().ranges,
          .angles = config.sv_net.angles,
          .symmetries = scored_orientations(config),
          .head = camera_head(config, backbone),
          .head_parameters = {},
          .input_fingerprint = fingerprint};
}

/// The input of the layers above `from` of sv_net.backbone, for the top views of the categories that are not held out.
std::unique_ptr<ViewInputs> training_inputs(const Run& run, FeaturesStage& features, const Backbone& backbone,
                                            NodeId from) {
  const Graph& graph = backbone.graph();
  const int orientations = trained_orientations(run.config);
  const bool all_frozen = graph.node(from).name == backbone.output_name();
  if (all_frozen && orientations == 1)
    return std::make_unique<FeatureInputs>(run.dataset,
                                           features.features(run.config.sv_net.backbone, run.config.sv_net.layer));
  if (std::holds_alternative<InputLayer>(graph.node(from).layer))
    return std::make_unique<ImageInputs>(run.dataset, backbone.preprocessing(), nullptr,
                                         ImageInputs::Options{.orientations = orientations});
  auto inputs = std::make_unique<ImageInputs>(
      run.dataset, backbone.preprocessing(),
      std::make_shared<Inference>(graph, backbone.parameters(), from, backbone.network().options()),
      ImageInputs::Options{.orientations = orientations, .flat = all_frozen});
  std::vector<Index> top_views;
  for (const auto& pose : run.dataset.poses)
    if (!run.held_out[static_cast<std::size_t>(pose.category)]) top_views.push_back(pose.top_view);
  inputs->keep(top_views, run.messages, run.communicator);
  return inputs;
}

/// The files of a training: the state after the last epoch, and after the best one.
struct CheckpointFiles {
  std::filesystem::path last, best;
};

/// The checkpoint to resume from, the same in every process, or nothing.
std::optional<Checkpoint> resumed_checkpoint(const Run& run, const CheckpointFiles& files, const Graph& graph,
                                             const std::string& fingerprint, const std::vector<Shape>& optimizer,
                                             Resume resume) {
  std::optional<Checkpoint> from;
  if (resume != Resume::never && run.communicator.is_root()) try {
      const bool same = io::read_checkpoint_fingerprint(files.last) == fingerprint;
      check(same || resume != Resume::any || !std::filesystem::exists(files.last), files.last.string(),
            ": a checkpoint of another training");
      if (same) from = io::read_checkpoint(files.last, graph, optimizer);
      // Within the first epoch there is no best one yet.
      if (from && from->epoch > 0 && io::read_checkpoint_fingerprint(files.best) != fingerprint) from.reset();
    } catch (const Error& error) {
      if (resume == Resume::any) throw;
      run.say(joined("training starts anew: ", error.what()));
    }
  if (run.communicator.broadcast(from.has_value()) == 0) return {};
  if (!from) from = io::read_checkpoint(files.last, graph, optimizer);
  run.say(joined("training: goes on after epoch ", from->epoch,
                 from->steps_in_epoch > 0 ? joined(" and ", from->steps_in_epoch, " steps of the next") : ""));
  return from;
}

/// Trains `graph` and puts the parameters of the best epoch into the model.
void train_into(Model& model, const Run& run, const Graph& graph, const TrainingSet& training,
                const TrainingSet* validation, Resume resume) {
  TrainerOptions options = trainer_options(run.config, model.input_fingerprint);
  options.convolution = run.inference.convolution;
  options.schedule = learning_rate_schedule(run.config, batch_count(options.batch_size, training.size()));
  Trainer trainer(graph, training, validation, options, run.communicator);
  const CheckpointFiles files{run.folder / "checkpoint-last.safetensors", run.folder / "checkpoint-best.safetensors"};
  auto from = resumed_checkpoint(run, files, graph, model.input_fingerprint, trainer.optimizer_shapes(), resume);
  std::optional<TrainingEvents> events;
  const auto write_metrics = [&](const Checkpoint& state) {
    io::write_atomically(run.folder / "metrics.csv", state.metrics);
    if (!events) events.emplace(run.folder);
    events->add(state.metrics);
  };
  // A run that was killed may have a newer checkpoint than metrics, and no epoch left that would write them.
  if (from && from->epoch > 0 && run.communicator.is_root()) write_metrics(*from);
  trainer.train(from ? std::move(*from)
                     : trainer.initial_state(
                           models::trained_parameters(graph, model.backbone_parameters, model.head, options.seed)),
                {.after_epoch =
                     [&](const Checkpoint& state, bool is_best) {
                       if (!run.communicator.is_root()) return;
                       if (is_best) write_checkpoint(files.best, state);
                       write_checkpoint(files.last, state);
                       write_metrics(state);
                     },
                 .interrupted =
                     [&](const Checkpoint& state) {
                       if (run.communicator.is_root()) write_checkpoint(files.last, state);
                     }},
                run.messages);
  run.communicator.barrier();  // the root process has written what all read
  models::take_trained(io::read_checkpoint_parameters(files.best, graph), model.backbone_parameters,
                       model.head_parameters);
}

/// Which view to take next, from the scores of pairs of views.
void learn_next_view(Model& model, const Run& run, FeaturesStage& features) {
  const PairScores pairs = pair_scores_stage(run, features);
  const std::vector<frame::ViewShape> shapes = features.view_shapes();
  const RidgeFit fit = fit_next_head({run.dataset, frame_spec(model), top_features(run, features, model), shapes},
                                     pairs.pairs, pairs.scores, run.seed());
  run.say(joined("next view: ridge regression of ", fit.weights.size(), " inputs on ", pairs.pairs.count(),
                 " pairs, penalty ", fit.penalty, ", explains ", 100 * (1 - fit.error),
                 " % of the variance beside a taken view, of categories left out"));
  set_next_head(model, fit);
}

/// A model in a frame other than `camera`.
Model make_frame_model(const Run& run, FeaturesStage& features, const Scores& scores, const std::string& fingerprint) {
  const Config& config = run.config;
  const Config::SvNet& sv_net = config.sv_net;
  Model model;
  model.frame = sv_net.frame;
  model.depth = sv_net.depth;
  if (frame::has_turns(sv_net.frame)) {
    const PrincipalComponents& components =
        features.turned_components(sv_net.backbone, sv_net.layer, run.training_categories());
    set_turned_backbone(model, features.backbone(sv_net.backbone, sv_net.layer).backbone, components);
  }
  // Gains are differences of scores of uniform views, which the scores stage has left in the run folder. The models of
  // rounds before the last have folders of their own, and need no gains.
  const bool has_rounds = config.scores.rounds > 0;
  const std::filesystem::path uniform_file = run.folder / "scores.h5";
  std::optional<Scores> uniform;
  if (has_rounds && std::filesystem::exists(uniform_file)) uniform = io::read_scores(uniform_file);
  const FrameHead fitted = fit_frame_head(run.dataset, top_features(run, features, model), scores,
                                          run.training_categories(), sv_net.target, frame_spec(model), run.seed(),
                                          sv_net.head, has_rounds ? (uniform ? &*uniform : nullptr) : &scores);
  const HeadFit& head = fitted.fit;
  run.say(joined("SV-net: ridge regression of ", head.ridge.weights.size(), " inputs, penalty ", head.ridge.penalty,
                 ", explains ", 100 * (1 - head.ridge.error),
                 " % of the variance within poses of categories left out"));
  if (!head.tried.empty()) run.say("SV-net: Spearman within poses of categories left out: " + tried_text(head.tried));
  if (!head.networks.empty())
    run.say(joined("SV-net: ", head.networks.size(), " networks",
                   head.ridge_share > 0 ? ", averaged with the ridge regression" : ""));
  set_frame_head(model, fitted);
  if (sv_net.next_view != NextViewChoice::none) learn_next_view(model, run, features);
  model.input_fingerprint = fingerprint;
  return model;
}

TrainedOn trained_on(const Run& run) {
  const std::vector<bool> learnt = category_use(run.held_out, run.config).learnt;
  TrainedOn on;
  for (std::size_t c = 0; c < learnt.size(); ++c)
    if (learnt[c]) on.categories.push_back(run.dataset.categories[c]);
  std::set<Index> objects;
  for (const ViewDataset::Pose& pose : run.dataset.poses)
    if (learnt[static_cast<std::size_t>(pose.category)]) {
      objects.insert(pose.object);
      ++on.top_views;
    }
  on.objects = static_cast<Index>(objects.size());
  return on;
}

Model make_model(const Run& run, FeaturesStage& features, const Scores& scores, const std::string& fingerprint,
                 Resume resume) {
  const Config& config = run.config;
  if (config.sv_net.frame != FrameChoice::camera) return make_frame_model(run, features, scores, fingerprint);
  const Backbone& backbone = features.backbone(config.sv_net.backbone, config.sv_net.layer).backbone;
  Model model = untrained_model(config, backbone, fingerprint);

  const CategoryUse use = category_use(run.held_out, config);
  const auto targets = [&](const std::vector<bool>& categories) {
    return view_targets(run.dataset, scores, categories, config.sv_net.target, config.training.target);
  };
  const std::unique_ptr<ViewInputs> inputs = training_inputs(run, features, backbone, first_trained(config, backbone));
  const TrainingSet training_set(run.dataset, *inputs, targets(use.learnt), model.angles);
  std::optional<TrainingSet> validation_set;
  if (config.training.validation_categories > 0)
    validation_set.emplace(run.dataset, *inputs, targets(use.validate), model.angles);
  const Graph trained = trained_network(config, backbone);
  run.say(joined("SV-net: ", trained.parameter_count(), " parameters, ", training_set.size(), " examples to learn from",
                 validation_set ? joined(", ", validation_set->size(), " to validate on") : std::string()));
  train_into(model, run, trained, training_set, validation_set ? &*validation_set : nullptr, resume);
  return model;
}

}  // namespace

Model model_stage(const Run& run, FeaturesStage& features, const Scores& scores, Resume resume) {
  const StageFile file{.path = run.folder / "model.safetensors",
                       .fingerprint = wanted_fingerprint(run, features),
                       .content = "SV-net",
                       .resume = resume};
  const auto make = [&] {
    Model model = make_model(run, features, scores, file.fingerprint, resume);
    model.trained_on = trained_on(run);
    return model;
  };
  return reuse_or_make(run, file, io::read_model, make, io::write_model);
}

bool model_is_current(const Run& run, FeaturesStage& features) {
  const auto path = run.folder / "model.safetensors";
  if (!std::filesystem::exists(path)) return false;
  try {
    return io::read_model_fingerprint(path) == wanted_fingerprint(run, features);
  } catch (const Error&) {
    return false;  // the stage says why it makes the model again
  }
}

Model trained_model(const Run& run, FeaturesStage& features) {
  const auto path = run.folder / "model.safetensors";
  check(std::filesystem::exists(path), run.folder.string(), ": holds no trained model; run svnet-train first");
  Model model = io::read_model(path);
  check(model.input_fingerprint == wanted_fingerprint(run, features), path.string(),
        ": was trained with another configuration, other images or other weights, or in another precision "
        "(SVNET_PRECISION); run svnet-train with this configuration first");
  return model;
}

}  // namespace svnet::train
