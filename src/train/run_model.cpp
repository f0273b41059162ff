#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sha256.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/models/checkpoint.h"
#include "models/trained_graph.h"
#include "predict/score_head.h"
#include "train/epoch_order.h"
#include "train/reused_file.h"
#include "train/run.h"
#include "train/scores_stage.h"
#include "train/trained_from.h"
#include "train/trainer.h"
#include "view/symmetry.h"

namespace svnet {
namespace {

TrainerOptions trainer_options(const Config& config, const std::string& fingerprint) {
  const auto& t = config.training;
  return {.epochs = t.epochs,
          .batch_size = t.batch_size,
          .optimizer = {.kind = t.optimizer, .momentum = t.momentum},
          .schedule = {},
          .seed = static_cast<std::uint64_t>(config.seed),
          .input_fingerprint = fingerprint};
}

Schedule schedule(const Config::Training& t, Index steps_per_epoch) {
  return {.kind = t.schedule,
          .base = t.learning_rate,
          .period = t.step_epochs * steps_per_epoch,
          .factor = t.step_factor,
          .total = t.epochs * steps_per_epoch};
}

}  // namespace

std::vector<bool> Run::validation_categories() const {
  std::vector<std::int32_t> candidates;
  for (std::size_t c = 0; c < held_out_.size(); ++c)
    if (!held_out_[c]) candidates.push_back(static_cast<std::int32_t>(c));
  const auto count = static_cast<Index>(candidates.size());
  const Index wanted = config_.training.validation_categories;
  check(wanted <= count - 2, "training.validation_categories: ", wanted, " of ", count,
        " training categories leave fewer than 2 to train on");
  RandomStream random(static_cast<std::uint64_t>(config_.seed), Stream::cross_validation);
  draw_without_replacement(random, candidates.data(), count, wanted);
  std::vector<bool> chosen(held_out_.size(), false);
  for (Index i = 0; i < wanted; ++i) chosen[static_cast<std::size_t>(candidates[static_cast<std::size_t>(i)])] = true;
  return chosen;
}

std::string Run::model_fingerprint() {
  const std::string features = features_fingerprint(config_.sv_net.backbone, config_.sv_net.layer);
  const std::string scores =
      scores_fingerprint(features_fingerprint(config_.scores.backbone, config_.scores.layer), config_);
  const auto& n = config_.sv_net;
  const auto& t = config_.training;
  Sha256 hash;
  hash.update_field("model 1").update_field(features).update_field(scores).update_field(
      joined_with("\n", config_.dataset.held_out));
  hash.update_field(joined(config_.seed, " ", n.width, " ", static_cast<int>(n.angles), " ", static_cast<int>(n.target),
                           " ", t.epochs, " ", t.batch_size, " ", static_cast<int>(t.optimizer), " ",
                           static_cast<int>(t.schedule), " ", t.step_epochs, " ", t.validation_categories, " ",
                           std::hexfloat, n.dropout, " ", t.learning_rate, " ", t.momentum, " ", t.step_factor));
  if (t.fine_tune != FineTune::none) hash.update_field(joined("fine_tune ", static_cast<int>(t.fine_tune)));
  if (n.orientations != Orientations::as_taken) hash.update_field("all orientations");
  if (t.augmentation != TopViewAugmentation::none)
    hash.update_field(joined("augmentation ", static_cast<int>(t.augmentation)));
  return hash.hex();
}

Model Run::model(Resume resume) {
  if (communicator_.is_root()) write_atomically(folder_ / "config.yaml", to_yaml(config_));
  const Scores& scores = this->scores();
  const std::string wanted = model_fingerprint();
  const auto path = folder_ / "model.safetensors";
  if (resume == Resume::automatic)
    if (auto model = reused_file(path, wanted, read_model, communicator_, messages_)) {
      say("SV-net: reused model.safetensors");
      return std::move(*model);
    }

  predicted_.reset();
  const BackboneWithOrigin& source = backbone(config_.sv_net.backbone, config_.sv_net.layer);
  const AngleEncoding angles = config_.sv_net.angles;
  Model model{.backbone = source.backbone.kind().name,
              .backbone_output = source.backbone.output_name(),
              .preprocessing = source.backbone.preprocessing(),
              .backbone_graph = source.backbone.graph(),
              .backbone_parameters = source.backbone.parameters(),
              .angles = angles,
              .symmetries = config_.sv_net.orientations == Orientations::all ? kSymmetries : 1,
              .head = sv_net({.features = source.backbone.dimension(),
                              .width = config_.sv_net.width,
                              .dropout = config_.sv_net.dropout,
                              .angles = angles}),
              .head_parameters = {},
              .input_fingerprint = wanted};

  const std::vector<bool> validating = validation_categories();
  std::vector<bool> training(held_out_.size());
  for (std::size_t c = 0; c < training.size(); ++c) training[c] = !held_out_[c] && !validating[c];
  const Target target = config_.sv_net.target;
  const NodeId output = source.backbone.graph().find(source.backbone.output_name());
  const NodeId from = trained_from(config_.training.fine_tune, source.backbone.kind(), source.backbone.graph(), output);
  const std::unique_ptr<ViewInputs> inputs = training_inputs(source.backbone, from);
  const TrainingSet training_set(dataset_, *inputs, scores, training, target, angles);
  std::optional<TrainingSet> validation_set;
  if (config_.training.validation_categories > 0)
    validation_set.emplace(dataset_, *inputs, scores, validating, target, angles);
  const Graph trained = trained_graph(source.backbone.graph(), from, output, model.head);
  say(joined("SV-net: ", trained.parameter_count(), " parameters, ", training_set.size(), " examples to learn from",
             validation_set ? joined(", ", validation_set->size(), " to validate on") : std::string()));
  train_into(model, trained, training_set, validation_set ? &*validation_set : nullptr, resume);
  if (communicator_.is_root()) write_model(path, model);
  return model;
}

Model Run::trained_model() {
  const auto path = folder_ / "model.safetensors";
  check(std::filesystem::exists(path), folder_.string(), ": holds no trained model; run svnet-train first");
  Model model = read_model(path);
  check(model.input_fingerprint == model_fingerprint(), path.string(),
        ": was trained with another configuration, other pictures or other weights; run svnet-train with this "
        "configuration first");
  return model;
}

std::unique_ptr<ViewInputs> Run::training_inputs(const Backbone& backbone, NodeId from) {
  const Graph& graph = backbone.graph();
  const int orientations = config_.training.augmentation == TopViewAugmentation::turns ? kSymmetries : 1;
  const bool all_frozen = graph.node(from).name == backbone.output_name();
  if (all_frozen && orientations == 1)
    return std::make_unique<FeatureInputs>(dataset_, features(config_.sv_net.backbone, config_.sv_net.layer));
  if (std::holds_alternative<InputLayer>(graph.node(from).layer))
    return std::make_unique<PictureInputs>(dataset_, backbone.preprocessing(), nullptr,
                                           PictureInputs::Options{.orientations = orientations});
  auto inputs = std::make_unique<PictureInputs>(
      dataset_, backbone.preprocessing(), std::make_shared<Inference>(graph, backbone.parameters(), from),
      PictureInputs::Options{.orientations = orientations, .flat = all_frozen});
  std::vector<Index> top_views;
  for (const auto& pose : dataset_.poses)
    if (!held_out_[static_cast<std::size_t>(pose.category)]) top_views.push_back(pose.top_view);
  inputs->keep(top_views, messages_, communicator_);
  return inputs;
}

void Run::train_into(Model& model, const Graph& graph, const TrainingSet& training, const TrainingSet* validation,
                     Resume resume) {
  TrainerOptions options = trainer_options(config_, model.input_fingerprint);
  options.schedule = schedule(config_.training, batch_count(options.batch_size, training.size()));
  Trainer trainer(graph, training, validation, options, communicator_);
  const auto last = folder_ / "checkpoint-last.safetensors", best = folder_ / "checkpoint-best.safetensors";
  std::optional<Checkpoint> from;
  if (resume == Resume::automatic && communicator_.is_root()) try {
      if (read_checkpoint_fingerprint(last) == model.input_fingerprint &&
          read_checkpoint_fingerprint(best) == model.input_fingerprint)
        from = read_checkpoint(last, graph, trainer.optimizer_shapes());
    } catch (const Error& error) {
      say(joined("training starts anew: ", error.what()));
    }
  if (communicator_.broadcast(from.has_value()) != 0) {
    if (!from) from = read_checkpoint(last, graph, trainer.optimizer_shapes());
    say(joined("training: goes on after epoch ", from->epoch));
  }
  trainer.train(
      from ? std::move(*from)
           : trainer.beginning(trained_parameters(graph, model.backbone_parameters, model.head, options.seed)),
      [&](const Checkpoint& state, bool is_best) {
        if (!communicator_.is_root()) return;
        if (is_best) write_checkpoint(best, state);
        write_checkpoint(last, state);
        write_atomically(folder_ / "metrics.csv", state.metrics);
      },
      messages_);
  communicator_.broadcast(0);  // has written what all read
  take_trained(read_checkpoint_parameters(best, graph), model.backbone_parameters, model.head_parameters);
}

const std::vector<double>& Run::predictions() {
  if (!predicted_) predicted_ = predicted_scores(trained_model());
  return *predicted_;
}

std::vector<double> Run::predicted_scores(const Model& model) {
  std::unique_ptr<ViewInputs> inputs;
  if (config_.training.fine_tune == FineTune::none && model.symmetries == 1)
    inputs = std::make_unique<FeatureInputs>(dataset_, features(config_.sv_net.backbone, config_.sv_net.layer));
  else
    inputs =
        std::make_unique<PictureInputs>(dataset_, model.preprocessing,
                                        std::make_shared<Inference>(model.backbone_graph, model.backbone_parameters,
                                                                    model.backbone_graph.find(model.backbone_output)),
                                        PictureInputs::Options{.orientations = model.symmetries, .flat = true});
  const ScoreHead head(model);
  const Index dimension = head.feature_count();
  const auto poses = std::span(dataset_.poses);
  std::vector<double> predicted;
  constexpr std::size_t kPoses = 16;  // whose pictures are looked at together
  for (std::size_t first = 0; first < poses.size(); first += kPoses) {
    const auto part = poses.subspan(first, std::min(kPoses, poses.size() - first));
    std::vector<Index> top_views;
    for (const auto& pose : part)
      for (int orientation = 0; orientation < model.symmetries; ++orientation)
        top_views.push_back(pose.top_view * model.symmetries + orientation);
    const Tensor features = inputs->batch(top_views);
    for (std::size_t p = 0; p < part.size(); ++p) {
      Tensor top = Tensor::empty({1, dimension});
      std::copy_n(features.data<float>() + static_cast<Index>(p) * dimension, dimension, top.data<float>());
      std::vector<CameraPose> candidates;
      for (const View& view :
           std::span(dataset_.views)
               .subspan(static_cast<std::size_t>(part[p].first_view), static_cast<std::size_t>(part[p].view_count)))
        candidates.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
      const std::vector<float> scores = head.scores(top, candidates);
      predicted.insert(predicted.end(), scores.begin(), scores.end());
    }
  }
  return predicted;
}

}  // namespace svnet
