// svnet-train: images become features, features scores, scores train SV-net.
#include "command/command.h"
#include "command/progress_text.h"
#include "evaluate_run.h"
#include "io/views/dataset_folder.h"
#include "mpi/mpi_communicator.h"
#include "train/config/config_file.h"
#include "train/run_folder.h"
#include "train/stages/dry_run.h"
#include "train/stages/features.h"
#include "train/stages/model.h"
#include "train/stages/plan.h"
#include "train/stages/scores.h"
#include "train/stages/training_summary.h"

namespace svnet {
using namespace command;
using train::Resume;

namespace {

/// "plan: scores: 30000000 problems, about 4 min 2 s"
std::string plan_line(const train::PlannedStage& stage) {
  std::string line = joined("plan: ", stage.stage, ": ", stage.work);
  if (stage.is_made) return line + ", made before";
  return stage.seconds ? line + ", about " + duration_text(*stage.seconds) : line;
}

int run(int argc, char** argv, Communicator& communicator) {
  Command command(
      "svnet-train",
      "Runs the stages features, scores and model of a configuration into a run folder; svnet-eval evaluates it.",
      "svnet-train configs/eth80.yaml --set dataset.root=photos --output runs/photos\n"
      "mpirun -n 4 svnet-train --threads 8 configs/eth80.yaml");
  std::filesystem::path config_file, output;
  std::vector<std::string> overrides;
  std::string resume = "auto";
  bool dry = false, open = false;
  command.add("CONFIG", config_file, "The configuration; configs/paper.yaml explains every key").required();
  command.add("--set", overrides, "Sets a key of the configuration; may be given several times")
      .value_name("KEY=VALUE")
      .one_value_per_use();
  command.add("--output", output, "The run folder (default: runs/<name of the configuration>)").value_name("DIR");
  command
      .add("--resume", resume,
           "auto: resumes training from the checkpoints of the same configuration; never: trains again")
      .one_of({"auto", "never"})
      .shows_default();
  command.add_flag("--dry-run", dry, "Every stage once on a few views of each category; leaves nothing behind");
  command.add_flag("--open", open, "Evaluates the model as svnet-eval does, and shows report.html in a browser");
  command.add_sandbox();
  return command.run(
      argc, argv,
      [&](Console& console) {
        if (open && communicator.size() > 1) wrong_usage("--open: several processes do not evaluate; use svnet-eval");
        const InferenceOptions inference = inference_options_from_environment();
        const train::Config config = train::read_config(config_file, overrides);
        ViewDataset dataset = io::read_view_dataset(config.dataset.root, config.dataset.exif_orientation);
        if (dry) {
          if (communicator.is_root()) dry_run(config, dataset, console.messages(), inference);
          console.result("dry run: every stage works");
          return;
        }
        if (output.empty()) output = std::filesystem::path("runs") / config_file.stem();
        train::check_run_folder(output, config.dataset.root);
        const auto lock = communicator.is_root() ? train::lock_run_folder(output) : nullptr;
        console.log_to(output / "log.txt");
        const train::Run run =
            make_run(config, std::move(dataset), output, console.messages(), communicator, inference);
        write_config(run);
        train::FeaturesStage features(run);
        if (communicator.is_root())
          for (const train::PlannedStage& stage : planned_stages(run, features)) console.line(plan_line(stage));
        const Scores scores = scores_stage(run, features);
        const Model model = model_stage(run, features, scores, resume == "auto" ? Resume::same : Resume::never);
        if (communicator.is_root()) {
          for (const std::string& line : training_summary(run, features, scores, model)) console.line(line);
          console.line(run.has_held_out_problems()
                           ? "svnet-eval " + output.string() + " compares them on held-out categories, in a report"
                           : "svnet-crossval tells how well such a model chooses for categories that it never saw");
        }
        console.result((output / "model.safetensors").string());
        if (open) evaluate_run(run, features, model, scores, {.open = true}, console);
      },
      communicator);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) { return svnet::main_with_communicator(argc, argv, "svnet-train", svnet::run); }
