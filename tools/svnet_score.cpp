// svnet-score: Monte-Carlo semantic scores of every view of a features file.
#include <algorithm>

#include "command/command.h"
#include "config_option.h"
#include "data/scores_summary.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "mpi/mpi_communicator.h"
#include "train/dataset_rows.h"
#include "train/stages/made_scores.h"
#include "train/stages/scores.h"

namespace svnet {
using namespace command;
using train::Resume;

namespace {

int run(int argc, char** argv, Communicator& communicator) {
  Command command("svnet-score",
                  "Writes the Monte-Carlo semantic scores of every view: how well it is clustered in random problems.",
                  "svnet-score --features features.h5 --dataset photos --output scores.h5 --exclude comb,hammer "
                  "--min-samples 2000\n"
                  "mpirun -n 8 svnet-score --threads 1 --features features.h5 --dataset photos --output scores.h5 "
                  "--problems 30000000 --resume");
  std::filesystem::path features_file, dataset_folder, output;
  std::vector<std::string> excluded;
  bool resume = false;
  double snapshot_seconds = 10;
  train::Config config;
  command.add("--features", features_file, "Features of every view (svnet-features)").required().value_name("FILE");
  command.add("--dataset", dataset_folder, "The dataset that the features are of").required().value_name("DIR");
  command.add("--output", output, "The file to write").required().value_name("FILE");
  command.add("--exclude", excluded, "Categories that take no part, separated by commas")
      .separated_by_commas()
      .value_name("NAMES");
  const auto key = [&](const char* option, const char* name) {
    return add_config_option(command, config, option, name);
  };
  const Argument samples = key("--min-samples", "scores.min_samples");
  const Argument problems = key("--problems", "scores.problems");
  const Argument error = key("--target-error", "scores.target_error");
  samples.excludes(problems).excludes(error);
  problems.excludes(error);
  key("--linkage", "scores.clustering");
  key("--singletons", "scores.singletons");
  key("--seed", "seed");
  const Argument fewest = key("--min-categories", "scores.min_categories");
  key("--max-categories", "scores.max_categories");
  key("--min-objects", "scores.min_objects");
  key("--max-objects", "scores.max_objects");
  command.add("--snapshot-seconds", snapshot_seconds, "Seconds between two snapshots of the work so far")
      .in_interval(0, 30)
      .shows_default();
  command.add_flag("--resume", resume, "Resume from OUTPUT.snapshot if it exists");
  command.add_sandbox();
  return command.run(
      argc, argv,
      [&](Console& console) {
        const auto& s = config.scores;
        if (s.min_samples == 0 && s.problems == 0 && s.target_error == 0)
          wrong_usage("give one of --min-samples, --problems, --target-error");
        config.dataset.held_out = excluded;
        if (communicator.is_root()) io::check_can_be_written(output, {features_file});
        ViewDataset dataset = io::read_view_dataset(dataset_folder);
        Features features = io::read_features(features_file);
        train::name_rows(dataset, features, features_file.string());
        train::check_rows(dataset, features.paths, features_file.string());
        // Features of other programs say nothing of the images.
        if (features.dataset_fingerprint.empty())
          features.dataset_fingerprint = io::fingerprint(dataset, Parallel::shared());
        // Scores need no pixels: features of turned images are as good.
        if (features.dataset_fingerprint != io::fingerprint(dataset, Parallel::shared()))
          dataset.exif_orientation = ExifOrientation::obey;
        check(dataset.exif_orientation == ExifOrientation::ignore ||
                  features.dataset_fingerprint == io::fingerprint(dataset, Parallel::shared()),
              features_file.string(), ": features of other images than those in ", dataset_folder.string(),
              "; run svnet-features again");
        const std::vector<bool> left_out = train::named_categories(dataset, excluded, "--exclude");
        const auto available = std::count(left_out.begin(), left_out.end(), false);
        check(available >= 2, available, " categories take part, at least 2 are needed",
              excluded.empty() ? "" : "; --exclude fewer");
        check(!fewest.given() || s.min_categories <= available, "--min-categories: ", s.min_categories, ", but ",
              available, " categories take part");
        const Scores scores = make_scores(output, dataset, features, left_out, config, console.messages(),
                                          {.resume = resume ? Resume::any : Resume::never,
                                           .snapshot_seconds = snapshot_seconds,
                                           .communicator = communicator});
        if (communicator.is_root()) train::write_made_scores(output, scores);
        console.result(joined(output.string(), ": ", scores.problems, " problems"));
        console.result(certainty_text(scores));
      },
      communicator);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) { return svnet::main_with_communicator(argc, argv, "svnet-score", svnet::run); }
