// svnet-score: Monte-Carlo semantic scores of every view of a features file.
#include <algorithm>

#include "command/command.h"
#include "command/number_check.h"
#include "command/openblas_cap.h"
#include "data/scores_summary.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "mpi/mpi_communicator.h"
#include "train/dataset_rows.h"
#include "train/stages/scores.h"

namespace svnet {
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
  std::string linkage = "ward", singletons = "zero";
  bool resume = false;
  double snapshot_seconds = 10;
  Config config;
  command.app()
      .add_option("--features", features_file, "Features of every view (svnet-features)")
      ->required()
      ->type_name("FILE");
  command.app()
      .add_option("--dataset", dataset_folder, "The dataset that the features are of")
      ->required()
      ->type_name("DIR");
  command.app().add_option("--output", output, "The file to write")->required()->type_name("FILE");
  command.app()
      .add_option("--exclude", excluded, "Categories that take no part, separated by commas")
      ->delimiter(',')
      ->type_name("NAMES");
  auto* samples =
      command.app()
          .add_option("--min-samples", config.scores.min_samples, "Until every view was in so many problems")
          ->check(CLI::Range(Index{1}, Index{1} << 32));
  auto* problems = command.app()
                       .add_option("--problems", config.scores.problems, "So many problems")
                       ->check(CLI::Range(Index{1}, Index{1} << 32));
  auto* error =
      command.app()
          .add_option("--target-error", config.scores.target_error, "Until every standard error is at most this")
          ->check(number_between(1e-9, 1));
  samples->excludes(problems)->excludes(error);
  problems->excludes(error);
  command.app()
      .add_option("--linkage", linkage, "How problems are clustered")
      ->check(CLI::IsMember(names_of<Clustering>()))
      ->capture_default_str();
  command.app()
      .add_option("--singletons", singletons,
                  "A view without a partner of its category counts 0 (zero) or is left out (skip)")
      ->check(CLI::IsMember(names_of<Singletons>()))
      ->capture_default_str();
  command.app()
      .add_option("--seed", config.seed, "Of the random problems")
      ->check(CLI::Range(Index{0}, Index{1} << 53))
      ->capture_default_str();
  const auto range = [&](const char* name, Index& value, const char* help) {
    return command.app()
        .add_option(name, value, help)
        ->check(CLI::Range(Index{0}, Index{1} << 31))
        ->capture_default_str();
  };
  const auto* fewest = range("--min-categories", config.scores.min_categories,
                             "Fewest categories of a problem, or all where there are fewer");
  range("--max-categories", config.scores.max_categories, "Most categories of a problem; 0: all");
  range("--min-objects", config.scores.min_objects, "Fewest objects of a category in a problem");
  range("--max-objects", config.scores.max_objects, "Most objects of a category in a problem; 0: all");
  command.app()
      .add_option("--snapshot-seconds", snapshot_seconds, "Seconds between two snapshots of the work so far")
      ->check(number_between(0, 30))
      ->capture_default_str();
  command.app().add_flag("--resume", resume, "Go on from OUTPUT.snapshot, which is kept up to date, where it exists");
  return command.run(
      argc, argv,
      [&](Console& console) {
        auto& s = config.scores;
        if (s.min_samples == 0 && s.problems == 0 && s.target_error == 0)
          wrong_usage("give one of --min-samples, --problems, --target-error");
        s.clustering = enum_from_name<Clustering>("--linkage", linkage);
        s.singletons = enum_from_name<Singletons>("--singletons", singletons);
        config.dataset.held_out = excluded;
        if (communicator.is_root()) check_can_be_written(output, {features_file});
        const ViewDataset dataset = read_view_dataset(dataset_folder);
        const Features features = read_features(features_file);
        check_rows(dataset, features.paths, features_file.string());
        check(features.dataset_fingerprint == fingerprint(dataset, Parallel::shared()), features_file.string(),
              ": features of other pictures than those in ", dataset_folder.string(), "; run svnet-features again");
        const std::vector<bool> left_out = named_categories(dataset, excluded, "--exclude");
        const auto available = std::count(left_out.begin(), left_out.end(), false);
        check(available >= 2, available, " categories take part, at least 2 are needed",
              excluded.empty() ? "" : "; --exclude fewer");
        check(fewest->empty() || s.min_categories <= available, "--min-categories: ", s.min_categories, ", but ",
              available, " categories take part");
        const Scores scores = make_scores(output, dataset, features, left_out, config, console.messages(),
                                          {.resume = resume ? Resume::any : Resume::never,
                                           .snapshot_seconds = snapshot_seconds,
                                           .communicator = communicator});
        if (communicator.is_root()) write_made_scores(output, scores);
        console.result(joined(output.string(), ": ", scores.problems, " problems"));
        console.result(certainty_text(scores));
      },
      communicator);
}

}  // namespace
}  // namespace svnet

int main(int argc, char** argv) {
  svnet::cap_openblas_from_environment(argv);  // may start the program again, which it must not once MPI has started
  return svnet::main_with_communicator(argc, argv, "svnet-score", svnet::run);
}
