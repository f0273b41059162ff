#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/models/model_file.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "train/config/config.h"
#include "train/evaluation_text.h"
#include "train/feature_extraction.h"
#include "train/training_set.h"

namespace svnet {

/// One run: a configuration, its dataset and its folder. Each stage takes what the stages before it left in the folder,
/// and is not run again while everything it depends on, down to the contents of pictures and weights, is the same:
/// its file says so by a fingerprint, and the log says which stages were reused.
/// Where the backbone is trained as well, it takes the pictures themselves. The processes of a communicator share the
/// work; each of them gets all results, the first one alone writes files.
///   features-<backbone>[-<layer>].h5 -> scores.h5 -> checkpoint-*.safetensors, metrics.csv, model.safetensors ->
///   evaluation.json, views.png
class Run {
 public:
  /// Hashes the dataset's pictures and checks, before any work, what the configuration asks for: categories, backbones,
  /// layers, weights, pipelines, problems. The folder is made where it does not exist. Throws Error for what does not
  /// fit.
  Run(Config config, ViewDataset dataset, std::filesystem::path folder, const Messages& messages,
      Communicator& communicator = SingleProcess::shared());

  const Config& config() const { return config_; }
  const ViewDataset& dataset() const { return dataset_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// "" stands for the pooled output. Made, or read, once per run; the reference lives as long as the run.
  const Features& features(const std::string& backbone, const std::string& layer);
  const Scores& scores();

  enum class Resume { automatic, never };
  /// Writes config.yaml, trains, or goes on training where a checkpoint of the same run was left, and writes the model.
  Model model(Resume resume = Resume::automatic);

  /// SV-net's score of every view of the dataset, by the model's own features of the top views.
  std::vector<double> predicted_scores(const Model& model);

  /// Both tables, of training and of held-out categories, and evaluation.json (also copied to `json` where given).
  /// Throws Error where the folder holds no model of this configuration: evaluating never trains.
  EvaluationTables evaluation(std::uint64_t problems, const std::optional<std::filesystem::path>& json = {});

  /// Writes views.png, a contact sheet of held-out objects: their top view, the view that SV-net chooses and the one
  /// that scores best among the held-out categories by so many problems. Nothing where fewer than 2 categories are held
  /// out.
  std::optional<std::filesystem::path> contact_sheet(std::uint64_t problems);

 private:
  void check_config();
  /// The backbone with its weights, loaded once.
  const BackboneWithOrigin& backbone(const std::string& name, const std::string& layer);
  std::string features_fingerprint(const std::string& backbone, const std::string& layer);
  Features made_features(const std::filesystem::path& path, const std::string& backbone, const std::string& layer);
  /// Of the model that this configuration leads to.
  std::string model_fingerprint();
  Model trained_model();
  /// predicted_scores of the model in the folder, computed once.
  const std::vector<double>& predictions();
  void train_into(Model& model, const Graph& graph, const TrainingSet& training, const TrainingSet* validation,
                  Resume resume);
  /// What the layers above `from` of sv_net.backbone take, for the top views of the categories that are not held out.
  std::unique_ptr<ViewInputs> training_inputs(const Backbone& backbone, NodeId from);
  std::vector<bool> validation_categories() const;
  void say(const std::string& line) const;

  Config config_;
  std::filesystem::path folder_;
  Messages messages_;
  Communicator& communicator_;
  ViewDataset dataset_;
  std::vector<bool> held_out_;  // per category
  std::string dataset_fingerprint_;
  std::map<std::string, BackboneWithOrigin> backbones_;
  std::map<std::filesystem::path, Features> features_;  // by their file
  std::optional<Scores> scores_;
  std::optional<std::vector<double>> predicted_;
};

/// Every stage once, on a few views of each category, in a folder that is removed again. Throws what a real run would.
void dry_run(const Config& config, const ViewDataset& dataset, const Messages& messages);

}  // namespace svnet
