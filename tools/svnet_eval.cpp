// svnet-eval: how well the views that SV-net chooses can be clustered.
#include "base/parallel.h"
#include "command/browser.h"
#include "command/command.h"
#include "config_option.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "report/collect.h"
#include "train/config/config_file.h"
#include "train/paper_figures.h"
#include "train/stages/contact_sheet.h"
#include "train/stages/evaluation.h"
#include "train/stages/evaluation_events.h"
#include "train/stages/held_out_scores.h"
#include "train/stages/model.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"
#include "train/view_targets.h"

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
  return command.run(argc, argv, [&](Console& console) {
    const bool folder_given = fs::is_directory(source);
    const fs::path folder = folder_given ? source : fs::path("runs") / source.stem();
    if (folder_given)
      check(fs::exists(source / "config.yaml"), source.string(),
            ": is no run folder, it has no config.yaml; svnet-train --output makes one");
    // A run's paths are relative to the folder itself, not to a link to it.
    const fs::path config_file = folder_given ? fs::canonical(source) / "config.yaml" : source;
    Config config = train::read_config(config_file, overrides);
    check(fs::exists(config.dataset.root), config.dataset.root.string(),
          ": no such folder; if the data set was moved, say where it is by --set dataset.root=DIR");
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
    const std::vector<double> predicted = predicted_scores(run, features, model);
    const Scores scores = scores_stage(run, features);
    const train::EvaluationInputs inputs{features, scores, predicted};
    const auto count = static_cast<std::uint64_t>(config.evaluation.problems);
    const auto tables = evaluation_stage(run, inputs, count, json.empty() ? std::optional<fs::path>() : json);
    const bool prints = !io::is_standard_output(json);
    const bool as_paper = train::holds_out_papers_categories(config);
    const auto print = [&](const train::EvaluationTable& table, const std::string& title, train::Split split) {
      console.result(table_text(table, title) + (as_paper ? paper_figures_text(table, split) : ""));
    };
    if (const auto held_out = tables.find("held_out"); prints && held_out != tables.end())
      print(held_out->second, "Held-out categories", train::Split::held_out);
    if (prints) {
      print(tables.at("training"), "Training categories", train::Split::training);
      console.result(columns_text(tables));
    }
    std::optional<semantics::SemanticScores> held_out_scores;
    if (run.has_held_out_problems()) held_out_scores = train::held_out_scores(run, features, count);
    if (held_out_scores) {
      const fs::path sheet = contact_sheet_stage(run, predicted, *held_out_scores);
      if (prints) console.result(joined("Views of held-out objects: ", sheet.string()));
    }
    write_evaluation_events(
        run, tables, predicted,
        held_out_scores ? target_scores(*held_out_scores, config.sv_net.target) : std::vector<double>());
    report::write_predictions(
        folder, run.dataset,
        report::predictions_of(run, predicted, scores, held_out_scores ? &*held_out_scores : nullptr));
    const fs::path page = report::write_report(run.config, run.dataset, folder, Parallel::shared());
    if (prints) console.result(joined("Report: ", page.string()));
    if (open) show_in_browser(page, console);
  });
}
