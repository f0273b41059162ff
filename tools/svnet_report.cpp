// svnet-report: the page of a run again, or several runs side by side.
#include "base/parallel.h"
#include "command/browser.h"
#include "command/command.h"
#include "io/files/atomic_file.h"
#include "io/views/dataset_folder.h"
#include "report/collect.h"
#include "report/comparison.h"
#include "run_config.h"
#include "train/config/config_file.h"

namespace {

namespace fs = std::filesystem;
using namespace svnet;
using namespace svnet::command;

/// Throws Error if the page would replace a file of a run other than its page.
void check_output(const fs::path& output, const std::vector<fs::path>& runs) {
  if (output.empty()) return;
  std::vector<fs::path> files;
  for (const fs::path& run : runs)
    for (const auto& entry : fs::directory_iterator(run))
      if (entry.path().filename() != "report.html") files.push_back(entry.path());
  io::check_can_be_written(output, files, io::Streams::allowed);
}

fs::path one_run(const fs::path& run, const std::vector<std::string>& overrides, const fs::path& output) {
  const train::Config config = train::read_config(config_file_of(run), overrides);
  check_data_exist(config);
  const ViewDataset dataset = io::read_view_dataset(config.dataset.root, config.dataset.exif_orientation);
  return report::write_report(config, dataset, run, Parallel::shared(), output);
}

fs::path side_by_side(const std::vector<fs::path>& runs, const fs::path& output) {
  std::vector<report::ComparedRun> compared;
  for (const fs::path& run : runs) compared.push_back(report::read_compared_run(run));
  report::name_apart(compared, runs);
  io::write_atomically(output, report::comparison_html(compared));
  return output;
}

}  // namespace

int main(int argc, char** argv) {
  Command command("svnet-report",
                  "Makes the page of a run, report.html in its folder, from what svnet-eval or svnet-crossval left "
                  "there. With several runs, makes one page that shows them side by side.",
                  "svnet-report runs/eth80 --open\n"
                  "svnet-report runs/seed-1 runs/seed-2 --output seeds.html");
  std::vector<fs::path> runs;
  std::vector<std::string> overrides;
  fs::path output;
  bool open = false;
  command.add("RUN", runs, "Run folders").required();
  command.add("--output", output, "The page (default: RUN/report.html; of several runs comparison.html)")
      .value_name("FILE");
  command
      .add("--set", overrides, "Sets a key of a single run's configuration; dataset.root=DIR for data that were moved")
      .value_name("KEY=VALUE")
      .one_value_per_use();
  command.add_flag("--open", open, "Shows the page in a browser");
  command.add_sandbox();
  return command.run(argc, argv, [&](Console& console) {
    if (runs.size() > 1 && !overrides.empty()) wrong_usage("--set is for a single run");
    for (const fs::path& run : runs) static_cast<void>(config_file_of(run));
    check_output(output, runs);
    const fs::path page = runs.size() == 1 ? one_run(runs.front(), overrides, output)
                                           : side_by_side(runs, output.empty() ? "comparison.html" : output);
    if (open) show_in_browser(page, console);
    if (!io::is_standard_output(page)) console.result("Report: " + page.string());
  });
}
