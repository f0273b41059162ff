#include "evaluate_run.h"

#include "base/parallel.h"
#include "base/text.h"
#include "command/browser.h"
#include "report/collect.h"
#include "train/paper_figures.h"
#include "train/stages/contact_sheet.h"
#include "train/stages/evaluation.h"
#include "train/stages/evaluation_events.h"
#include "train/stages/held_out_results.h"
#include "train/stages/held_out_scores.h"
#include "train/stages/predictions.h"
#include "train/view_targets.h"

namespace svnet::command {
namespace fs = std::filesystem;

namespace {

void print_tables(const train::Config& config, const train::EvaluationTables& tables, Console& console) {
  const bool as_paper = train::holds_out_papers_categories(config);
  const auto print = [&](const train::EvaluationTable& table, const std::string& title, train::Split split) {
    console.result(table_text(table, title) + (as_paper ? paper_figures_text(table, split) : ""));
  };
  if (const auto held_out = tables.find("held_out"); held_out != tables.end())
    print(held_out->second, "Held-out categories", train::Split::held_out);
  print(tables.at("training"), "Training categories", train::Split::training);
  console.result(columns_text(tables));
}

}  // namespace

void evaluate_run(const train::Run& run, train::FeaturesStage& features, const Model& model, const Scores& scores,
                  const EvaluationOutput& output, Console& console) {
  const train::Config& config = run.config;
  const auto problems = static_cast<std::uint64_t>(config.evaluation.problems);
  const std::vector<double> predicted = predicted_scores(run, features, model);
  std::optional<semantics::SemanticScores> held_out;
  if (run.has_held_out_problems()) held_out = held_out_scores(run, features, problems);
  const train::EvaluationInputs inputs{features, scores, predicted, held_out ? &*held_out : nullptr,
                                       next_scores(run, features, model)};
  const auto tables = evaluation_stage(run, inputs, problems, output.json);
  if (const auto table = tables.find("held_out"); table != tables.end())
    keep_held_out_results(run, model, table->second);
  if (output.prints) print_tables(config, tables, console);

  if (const auto sheet = contact_sheet_stage(run, inputs, problems); sheet && output.prints)
    console.result("Views of held-out objects: " + sheet->string());
  write_evaluation_events(run, tables, predicted,
                          held_out ? target_scores(*held_out, config.sv_net.target) : std::vector<double>());
  report::write_predictions(run.folder, run.dataset, report::predictions_of(run, predicted, scores, inputs.held_out));
  const fs::path page = report::write_report(config, run.dataset, run.folder, Parallel::shared());
  if (output.open) show_in_browser(page, console);
  if (output.prints) console.result("Report: " + page.string());
}

}  // namespace svnet::command
