// svnet-crossval: how well SV-net chooses views of categories that it never saw.
#include "base/parallel.h"
#include "base/split.h"
#include "command/browser.h"
#include "command/command.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "report/collect.h"
#include "train/config/config_file.h"
#include "train/evaluation_text.h"
#include "train/run_folder.h"
#include "train/stages/cross_validation.h"
#include "train/stages/cross_validation_text.h"

namespace {

namespace fs = std::filesystem;
using namespace svnet;
using namespace svnet::command;
using train::Fold;

/// Every combination of the values of the sweeps, as overrides "key=value"; one empty list if there is no sweep.
std::vector<std::vector<std::string>> combinations(const std::vector<std::string>& sweeps) {
  std::vector<std::vector<std::string>> all{{}};
  for (const std::string& sweep : sweeps) {
    const auto equals = sweep.find('=');
    check(equals != std::string::npos && equals + 1 < sweep.size(), "--sweep: '", sweep,
          "' is not of the form key=value,value");
    std::vector<std::vector<std::string>> longer;
    for (const auto& settings : all)
      for (const std::string& value : split(sweep.substr(equals + 1), ',')) {
        longer.push_back(settings);
        longer.back().push_back(sweep.substr(0, equals + 1) + value);
      }
    all = std::move(longer);
  }
  return all;
}

struct Arguments {
  fs::path config_file, output;
  std::vector<std::string> overrides, folds, sweeps;
  Index fold_count = 6, repeats = 1, each_choice_of = 0;
  bool open = false;

  train::FoldProblems problems() const {
    return each_choice_of > 0 ? train::FoldProblems::own_categories : train::FoldProblems::all_categories;
  }
};

struct VariedRun {
  std::string settings;
  train::Run run;
};

/// The run with every combination of the values of the sweeps; all of them are checked.
std::vector<VariedRun> varied_runs(const Arguments& arguments, const train::Run& base) {
  std::vector<VariedRun> runs;
  for (const auto& settings : combinations(arguments.sweeps)) {
    std::vector<std::string> overrides = arguments.overrides;
    overrides.insert(overrides.end(), settings.begin(), settings.end());
    runs.push_back(
        {joined_with(", ", settings), with_config(base, train::read_config(arguments.config_file, overrides))});
  }
  return runs;
}

/// The folds of each repetition.
std::vector<std::vector<Fold>> folds_of(const Arguments& arguments, const ViewDataset& dataset, std::uint64_t seed) {
  if (arguments.each_choice_of > 0) return {train::each_choice_of(dataset, arguments.each_choice_of)};
  if (!arguments.folds.empty()) {
    std::vector<Fold> given;
    for (const std::string& fold : arguments.folds) given.push_back(split(fold, ','));
    return {train::completed_folds(dataset, std::move(given))};
  }
  std::vector<std::vector<Fold>> all;
  for (Index repeat = 0; repeat < arguments.repeats; ++repeat)
    all.push_back(train::drawn_folds(dataset, arguments.fold_count, seed + static_cast<std::uint64_t>(repeat)));
  return all;
}

void cross_validate(const Arguments& arguments, Console& console) {
  const train::Config config = train::read_config(arguments.config_file, arguments.overrides);
  ViewDataset dataset = io::read_view_dataset(config.dataset.root, config.dataset.exif_orientation);
  train::check_run_folder(arguments.output, config.dataset.root);
  const auto lock = train::lock_run_folder(arguments.output);
  console.log_to(arguments.output / "log.txt");
  const train::Run base = make_run(config, std::move(dataset), arguments.output, console.messages(),
                                   SingleProcess::shared(), inference_options_from_environment());
  write_config(base);
  const auto repeats = folds_of(arguments, base.dataset, base.seed());
  const std::vector<VariedRun> runs = varied_runs(arguments, base);
  std::vector<train::NamedCrossValidation> validations;
  for (const auto& [settings, run] : runs) {
    train::FeaturesStage features(run);
    for (std::size_t repeat = 0; repeat < repeats.size(); ++repeat) {
      std::string name = settings;
      if (repeats.size() > 1) name += joined(name.empty() ? "" : ", ", "repeat ", repeat + 1);
      validations.push_back({name, train::cross_validate(run, features, repeats[repeat], arguments.problems())});
      console.result(cross_validation_text(validations.back()));
    }
  }
  io::write_atomically(arguments.output / "crossval.json", cross_validation_json(validations));
  io::write_atomically(arguments.output / "evaluation.json",
                       train::tables_json({{"held_out", validations.front().result.table}}));
  if (const auto sheet = train::cross_validation_sheet(base, validations.front().result))
    console.result("Views of some objects: " + sheet->string());
  console.result((arguments.output / "crossval.json").string());
  report::write_predictions(arguments.output, base.dataset,
                            report::predictions_of(runs.front().run, validations.front().result));
  const fs::path page =
      report::write_report(runs.front().run.config, base.dataset, arguments.output, Parallel::shared());
  if (arguments.open) show_in_browser(page, console);
  console.result("Report: " + page.string());
}

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-crossval",
                  "Cross-validation over categories: trains a model for each fold without the fold's categories, lets "
                  "it choose their views, and compares all choices with fixed rules, random views and the best views. "
                  "Features, scores and models are kept in the output folder and reused. report.html there shows the "
                  "results.",
                  "svnet-crossval configs/eth80.yaml --folds 4 --output runs/eth80-crossval\n"
                  "svnet-crossval configs/eth80.yaml --fold apple,car --sweep scores.rounds=0,2 --output runs/rounds");
  Arguments arguments;
  command.add("CONFIG", arguments.config_file, "The configuration; its dataset.held_out must be empty").required();
  command.add("--set", arguments.overrides, "Sets a key of the configuration; may be given several times")
      .value_name("KEY=VALUE")
      .one_value_per_use();
  const Argument count = command.add("--folds", arguments.fold_count, "Number of folds, drawn from the seed");
  count.value_name("K").positive().shows_default();
  const Argument each = command.add("--each-choice-of", arguments.each_choice_of,
                                    "Instead, holds out every choice of N categories in turn, such as all 56 choices "
                                    "of 3 of 8, and judges each by problems of its own categories");
  each.value_name("N").positive().excludes(count);
  command
      .add("--fold", arguments.folds,
           "Categories of one fold, separated by commas; may be given several times. Categories in no fold make one "
           "more")
      .value_name("NAMES")
      .one_value_per_use()
      .excludes(count)
      .excludes(each);
  command
      .add(
          "--sweep", arguments.sweeps,
          "Makes the cross-validation with each of these values of a key; may be given several times. To choose by the "
          "result makes the result of the best one too good")
      .value_name("KEY=A,B")
      .one_value_per_use();
  command.add("--repeats", arguments.repeats, "Repeats everything with other folds")
      .value_name("N")
      .positive()
      .shows_default();
  command.add("--output", arguments.output, "The folder of the results").required().value_name("DIR");
  command.add_flag("--open", arguments.open, "Shows report.html in a browser");
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) { cross_validate(arguments, console); });
}
