// svnet-train: pictures become features, features scores, scores train SV-net.
#include "command/command.h"
#include "command/openblas_cap.h"
#include "io/views/dataset_folder.h"
#include "mpi/mpi_communicator.h"
#include "train/run_folder.h"
#include "train/stages/dry_run.h"
#include "train/stages/features.h"
#include "train/stages/model.h"
#include "train/stages/scores.h"

namespace svnet {
namespace {

int run(int argc, char** argv, Communicator& communicator) {
  Command command("svnet-train",
                  "Runs every stage of a configuration into a run folder: features, scores, training, model.",
                  "svnet-train configs/eth80.yaml --set dataset.root=photos --output runs/photos\n"
                  "mpirun -n 4 svnet-train --threads 8 configs/eth80.yaml");
  std::filesystem::path config_file, output;
  std::vector<std::string> overrides;
  std::string resume = "auto";
  bool dry = false;
  command.app()
      .add_option("CONFIG", config_file, "The configuration; configs/paper.yaml explains every key")
      ->required();
  command.app()
      .add_option("--set", overrides, "Sets a key of the configuration; may be given several times")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.app()
      .add_option("--output", output, "The run folder (default: runs/<name of the configuration>)")
      ->type_name("DIR");
  command.app()
      .add_option("--resume", resume, "auto: goes on with what the folder holds of the same run; never: trains anew")
      ->check(CLI::IsMember({"auto", "never"}))
      ->capture_default_str();
  command.app().add_flag("--dry-run", dry, "Every stage once on a few views of each category; leaves nothing behind");
  return command.run(
      argc, argv,
      [&](Console& console) {
        const Config config = read_config(config_file, overrides);
        ViewDataset dataset = read_view_dataset(config.dataset.root);
        if (dry) {
          if (communicator.is_root()) dry_run(config, dataset, console.messages());
          console.result("dry run: every stage works");
          return;
        }
        if (output.empty()) output = std::filesystem::path("runs") / config_file.stem();
        check_run_folder(output, config.dataset.root);
        console.log_to(output / "log.txt");
        const Run run = make_run(config, std::move(dataset), output, console.messages(), communicator);
        write_config(run);
        FeaturesStage features(run);
        const Scores scores = scores_stage(run, features);
        model_stage(run, features, scores, resume == "auto" ? Resume::same : Resume::never);
        console.result((output / "model.safetensors").string());
      },
      communicator);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) {
  svnet::cap_openblas_from_environment(argv);  // may start the program again, which it must not once MPI has started
  return svnet::main_with_communicator(argc, argv, "svnet-train", svnet::run);
}
