// svnet-eval: how well the views that SV-net chooses can be clustered.
#include "command/command.h"
#include "config_option.h"
#include "evaluate_run.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "run_config.h"
#include "train/config/config_file.h"
#include "train/selectors.h"
#include "train/stages/model.h"
#include "train/stages/scores.h"

namespace {

namespace fs = std::filesystem;

/// The configuration and all files of a run folder but evaluation.json, which --json may name.
std::vector<fs::path> files_of_run(const fs::path& folder, const fs::path& config) {
  std::vector<fs::path> files{config};
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != "evaluation.json") files.push_back(entry.path());
  return files;
}

std::vector<std::string> selector_names() {
  std::vector<std::string> names;
  for (const svnet::train::SelectorKind& kind : svnet::train::selector_kinds()) names.emplace_back(kind.name);
  return names;
}

std::string selectors_help() {
  std::string help = "Selectors of the tables, separated by commas (default: evaluation.selectors)";
  for (const svnet::train::SelectorKind& kind : svnet::train::selector_kinds())
    help += std::string("; ") + kind.name + ": " + kind.help;
  return help;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace svnet;
  using namespace svnet::command;
  using svnet::train::Config;
  Command command(
      "svnet-eval",
      "Prints the tables of held-out and of training categories and writes evaluation.json into the run folder, "
      "views.png: held-out objects from above, from the view that SV-net chooses, and from the best view, and "
      "report.html, a "
      "page that shows all of it.",
      "svnet-eval runs/eth80 --problems 1000");
  fs::path source, json;
  std::vector<std::string> selectors;
  Config given;  // by options
  std::vector<std::string> overrides;
  bool open = false;
  command.add("CONFIG|RUN_DIR", source, "A run folder, or the configuration of runs/<its name>").required();
  command.add("--set", overrides, "Sets a key of the configuration; dataset.root=DIR for data that were moved")
      .value_name("KEY=VALUE")
      .one_value_per_use();
  const Argument problems =
      add_config_option(command, given, "--problems", "evaluation.problems").shows_default("evaluation.problems");
  command.add("--selectors", selectors, selectors_help())
      .separated_by_commas()
      .one_of(selector_names())
      .value_name("NAMES");
  command.add("--json", json, "Writes evaluation.json here too. With /dev/stdout no tables are printed")
      .value_name("FILE");
  command.add_flag("--open", open, "Shows report.html in a browser");
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    const bool folder_given = fs::is_directory(source);
    const fs::path folder = folder_given ? source : fs::path("runs") / source.stem();
    const fs::path config_file = folder_given ? config_file_of(source) : source;
    Config config = train::read_config(config_file, overrides);
    check_data_exist(config);
    if (problems.given()) config.evaluation.problems = given.evaluation.problems;
    if (!selectors.empty()) config.evaluation.selectors = selectors;
    ViewDataset dataset = io::read_view_dataset(config.dataset.root, config.dataset.exif_orientation);
    check(fs::exists(folder / "model.safetensors"), folder.string(), ": holds no trained model; run svnet-train first");
    if (!json.empty()) io::check_can_be_written(json, files_of_run(folder, config_file), io::Streams::allowed);
    console.log_to(folder / "log.txt");
    const train::Run run = make_run(config, std::move(dataset), folder, console.messages(), SingleProcess::shared(),
                                    inference_options_from_environment());
    train::FeaturesStage features(run);
    const Model model = trained_model(run, features);
    const bool prints = !io::is_standard_output(json);
    evaluate_run(run, features, model, scores_stage(run, features),
                 {.json = json.empty() ? std::optional<fs::path>() : json, .prints = prints, .open = open}, console);
  });
}
