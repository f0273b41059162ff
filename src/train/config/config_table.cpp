#include "train/config/config_table.h"

#include "base/error.h"
#include "base/text.h"
#include "semantics/score_sums.h"
#include "train/config/pipeline_name.h"

namespace svnet::train {
namespace {

using Names = std::vector<std::string>;
using std::filesystem::path;

BoundKey whole(Stage stage, std::string name, Index& field, NumberRange range, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          described(range, true),
          "N",
          [&field, range](const YamlValue& value, const path&) { field = yaml_whole_number(value, range); },
          [&field](const path&) { return std::to_string(field); }};
}

BoundKey number(Stage stage, std::string name, double& field, NumberRange range, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          described(range, false),
          "X",
          [&field, range](const YamlValue& value, const path&) { field = yaml_number(value, range); },
          [&field](const path&) { return written_yaml(field); }};
}

BoundKey text(Stage stage, std::string name, std::string& field, std::string accepts, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          std::move(accepts),
          "NAME",
          [&field](const YamlValue& value, const path&) { field = yaml_text(value); },
          [&field](const path&) { return written_yaml(field); }};
}

template <class Enum>
BoundKey choice(Stage stage, std::string name, Enum& field, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          described(names_of<Enum>()),
          "{" + joined_with(",", names_of<Enum>()) + "}",
          [&field](const YamlValue& value, const path&) { field = yaml_choice<Enum>(value); },
          [&field](const path&) { return written_yaml(std::string_view(name_of(field))); }};
}

BoundKey folder_path(Stage stage, std::string name, path& field, std::string accepts, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          std::move(accepts),
          "DIR",
          [&field](const YamlValue& value, const path& folder) {
            const std::string given = yaml_text(value);
            field = given.empty() ? path() : (folder / given).lexically_normal();
            if (!field.empty() && !field.has_filename()) field = field.parent_path();  // "views/" is "views"
          },
          [&field](const path& folder) {
            return written_yaml((folder.empty() || field.empty() ? field : field.lexically_relative(folder)).string());
          }};
}

BoundKey names(Stage stage, std::string name, Names& field, std::string help) {
  return {std::move(name),
          stage,
          std::move(help),
          "a list of names",
          "NAMES",
          [&field](const YamlValue& value, const path&) { field = yaml_texts(value); },
          [&field](const path&) { return written_yaml(field); }};
}

BoundKey later(BoundKey key) {
  key.default_counts = false;
  return key;
}

BoundKey pipelines(Stage stage, std::string name, Names& field, std::string help) {
  BoundKey key = names(stage, std::move(name), field, std::move(help));
  key.accepts = "a list of BACKBONE_CLUSTERING";
  key.read = [&field](const YamlValue& value, const path&) {
    field = yaml_texts(value);
    for (const auto& item : value.items) parse_pipeline(item.text, item.where());
  };
  return key;
}

}  // namespace

std::vector<BoundKey> bound_keys(Config& c) {
  constexpr NumberRange kNotNegative{.min = 0}, kPositive{.min = 0, .min_open = true}, kFromOne{.min = 1};
  constexpr NumberRange kProblems{.min = 0, .max = static_cast<double>(semantics::ScoreSums::kMostProblems)};
  constexpr NumberRange kBelowOne{.min = 0, .max = 1, .max_open = true};
  const std::string backbone = "a backbone's name", layer = "a layer's name, or \"\"";
  return {
      choice(
          Stage::evaluation, "preset", c.preset,
          "The settings that the other keys start from. paper: the defaults. turns: features that are not pooled, in "
          "eight orientations. best: the object's own axis and on-policy scores."),
      whole(Stage::scores, "seed", c.seed, kNotNegative, "Everything random is drawn from this seed."),

      folder_path(Stage::features, "dataset.root", c.dataset.root, "a folder, required",
                  "Folder of the images, CATEGORY/OBJECT/POSE/PHI_THETA.png (or .jpg, .jpeg, .webp)."),
      names(Stage::scores, "dataset.held_out", c.dataset.held_out,
            "Categories that take part neither in the scores nor in training."),
      choice(Stage::features, "dataset.exif_orientation", c.dataset.exif_orientation,
             "Take pixels as stored, or turn them as the EXIF orientation says."),

      folder_path(Stage::features, "weights.folder", c.weights.folder, "a folder, or \"\"",
                  "Folder of pretrained weights. Empty: built-in weights, or random ones."),

      text(Stage::features, "scores.backbone", c.scores.backbone, backbone,
           "Backbone of the features that are clustered."),
      text(Stage::features, "scores.layer", c.scores.layer, layer,
           "Layer whose output is clustered. Empty: the pooled output."),
      names(Stage::features, "scores.backbones", c.scores.backbones,
            "Backbones whose scores are averaged; scores.layer is only of scores.backbone. Empty: scores.backbone."),
      choice(Stage::scores, "scores.clustering", c.scores.clustering,
             "Agglomerative clustering by its linkage, or k-means."),
      whole(Stage::scores, "scores.min_samples", c.scores.min_samples, kProblems,
            "Stop once every view has been in at least N problems. 0: off."),
      whole(Stage::scores, "scores.problems", c.scores.problems, kProblems, "Stop after N problems. 0: off."),
      number(Stage::scores, "scores.target_error", c.scores.target_error, kNotNegative,
             "Stop once the standard error of every score is at most this. 0: off."),
      whole(Stage::scores, "scores.min_categories", c.scores.min_categories, {.min = 2},
            "Fewest categories in a problem; all of them if there are fewer."),
      whole(Stage::scores, "scores.max_categories", c.scores.max_categories, kNotNegative,
            "Most categories in a problem. 0: all."),
      whole(Stage::scores, "scores.min_objects", c.scores.min_objects, kFromOne,
            "Fewest objects of a category in a problem."),
      whole(Stage::scores, "scores.max_objects", c.scores.max_objects, kNotNegative,
            "Most objects of a category in a problem. 0: all."),
      choice(Stage::scores, "scores.singletons", c.scores.singletons,
             "A singleton scores zero, or is left out of the mean of individual scores."),
      later(whole(Stage::scores, "scores.rounds", c.scores.rounds, kNotNegative,
                  "Times that scores are made again with on-policy views: those that a model of the last scores would "
                  "choose. 0: uniform views only.")),

      later(choice(Stage::model, "sv_net.frame", c.sv_net.frame,
                   "camera: features of the top image as taken, and the angles. axis: what is measured from the "
                   "object's own axis, fitted by ridge regression, without a backbone. turned: features of the top "
                   "image turned to the camera, fitted by ridge regression. turned_axis: both.")),
      later(choice(Stage::model, "sv_net.depth", c.sv_net.depth,
                   "heights: what the depth of the top views says of heights above the table goes in too; frames axis "
                   "and turned_axis only.")),
      later(choice(Stage::model, "sv_net.head", c.sv_net.head,
                   "In other frames than camera: ridge regression, a small network (four of them, averaged), both "
                   "averaged, or the best of these by cross-validation over the training categories.")),
      later(
          choice(Stage::model, "sv_net.next_view", c.sv_net.next_view,
                 "ridge: also learn, from scores of pairs of views, which view to take next, given the views taken and "
                 "their pictures; in other frames than camera.")),
      text(Stage::features, "sv_net.backbone", c.sv_net.backbone, backbone,
           "Backbone of the features of the top image."),
      text(Stage::features, "sv_net.layer", c.sv_net.layer, layer,
           "Layer that feeds the head. Empty: the pooled output."),
      whole(Stage::model, "sv_net.width", c.sv_net.width, kFromOne, "Width of the head's fully connected layers."),
      number(Stage::model, "sv_net.dropout", c.sv_net.dropout, kBelowOne,
             "Fraction of the activations that dropout sets to zero."),
      choice(Stage::model, "sv_net.angles", c.sv_net.angles, "Encoding of the camera pose for the head."),
      choice(Stage::model, "sv_net.target", c.sv_net.target, "Score that SV-net learns."),
      choice(Stage::model, "sv_net.orientations", c.sv_net.orientations,
             "Score the top image as taken, or average over its eight orientations."),

      whole(Stage::model, "training.epochs", c.training.epochs, kFromOne, "Passes over the training examples."),
      whole(Stage::model, "training.batch_size", c.training.batch_size, {.min = 2}, "Examples in a step."),
      number(Stage::model, "training.learning_rate", c.training.learning_rate, kPositive,
             "Learning rate at the start."),
      choice(Stage::model, "training.optimizer", c.training.optimizer, "Optimizer."),
      number(Stage::model, "training.momentum", c.training.momentum, kBelowOne, "Momentum; sgd only."),
      choice(Stage::model, "training.schedule", c.training.schedule, "How the learning rate changes over the epochs."),
      whole(Stage::model, "training.step_epochs", c.training.step_epochs, kFromOne,
            "Epochs between two steps; schedule step only."),
      number(Stage::model, "training.step_factor", c.training.step_factor, {.min = 0, .max = 1, .min_open = true},
             "The learning rate is multiplied by this at each step; schedule step only."),
      later(choice(Stage::model, "training.target", c.training.target,
                   "scaled: the score, scaled to [0, 1] among the views of its pose. centred: the score minus the mean "
                   "of its pose, weighted by what is known of it; frame camera only, others are always centred.")),
      whole(Stage::model, "training.validation_categories", c.training.validation_categories, kNotNegative,
            "Training categories, drawn at random, that choose the best checkpoint: the one that ranks the views of "
            "their poses best. 0: none."),
      later(whole(Stage::model, "training.patience", c.training.patience, kNotNegative,
                  "Stop after N epochs without a better checkpoint. 0: never.")),
      choice(Stage::model, "training.fine_tune", c.training.fine_tune,
             "Part of sv_net.backbone that is trained together with the head."),
      choice(Stage::model, "training.augmentation", c.training.augmentation,
             "turns: train on each top image in its eight orientations."),

      whole(Stage::evaluation, "evaluation.problems", c.evaluation.problems, kFromOne,
            "Number of problems that each table averages over."),
      pipelines(Stage::evaluation, "evaluation.pipelines", c.evaluation.pipelines,
                "Pipelines of the tables. Empty: only the pipeline of the scores."),
      names(Stage::evaluation, "evaluation.selectors", c.evaluation.selectors,
            "Selectors of the tables. Empty: the default ones of each table; svnet-eval --help lists all."),
      later(whole(
          Stage::evaluation, "evaluation.views", c.evaluation.views, {1, 8},
          "Compare selectors of up to N views of each object, such as svnet_2: a random view, SV-net and the best "
          "views.")),
      later(choice(Stage::evaluation, "evaluation.fusion", c.evaluation.fusion,
                   "How several views of an object are clustered: by the mean of their features, by all features, or "
                   "each by itself and "
                   "then by what most of these clusterings put together.")),
      choice(Stage::evaluation, "evaluation.nmi", c.evaluation.nmi,
             "Mean that normalises NMI. The paper's tables use geometric."),
  };
}

BoundKey bound_key(Config& config, const std::string& name) {
  for (const BoundKey& key : bound_keys(config))
    if (key.name == name) return key;
  fail("[config] there is no key '", name, "'");
}

}  // namespace svnet::train
