#include "report/comparison.h"

#include <catch2/catch.hpp>

#include "small_report.h"
#include "temporary_folder.h"
#include "train/config/config_file.h"

using namespace svnet;
using namespace svnet::report;
using Catch::Contains;

namespace {

std::vector<ComparedRun> two_runs() {
  const RunReport report = small_report();
  ComparedRun a{
      .name = "a", .settings = {{"seed", "0"}, {"sv_net.width", "64"}}, .tables = report.tables, .curves = {}};
  ComparedRun b = a;
  b.name = "b <i>";
  b.settings[0].value = "1";
  b.curves = TrainingCurves{{0.5, 0.4}, {}, {}, {}};
  return {a, b};
}

}  // namespace

TEST_CASE("a comparison shows the keys that differ, and no others") {
  const auto lines = differing_settings(two_runs());
  REQUIRE(lines.size() == 1);
  CHECK(lines[0] == std::vector<std::string>{"seed", "0", "1"});
  const std::string html = comparison_html(two_runs());
  CHECK_THAT(html, Contains(">seed<") && !Contains("sv_net.width"));
  CHECK_THAT(html, Contains("b &lt;i&gt;") && !Contains("<i>"));
  CHECK_THAT(html, Contains("SV-net is +0.061 [+0.035, +0.088] Fowlkes–Mallows index (FM) ahead of random views"));
  CHECK_THAT(html, Contains("<polyline") && !Contains("http"));
}

TEST_CASE("runs with equal settings are said to have them") {
  std::vector<ComparedRun> runs = two_runs();
  runs[1].settings = runs[0].settings;
  runs[1].curves.reset();
  const std::string html = comparison_html(runs);
  CHECK_THAT(html, Contains("All keys of the configurations are equal.") && Contains("No run has a metrics.csv"));
}

TEST_CASE("runs of the same folder name are told apart by their paths") {
  std::vector<ComparedRun> runs = two_runs();
  runs[1].name = "a";
  name_apart(runs, {"x/a", "y/a"});
  CHECK(runs[0].name == "x/a");
  CHECK(runs[1].name == "y/a");
}

TEST_CASE("the settings of a run are all keys of its configuration") {
  const TemporaryFolder folder;
  folder.write("run/config.yaml", "seed: 5\ndataset:\n  root: data\nscores:\n  min_samples: 10\n");
  folder.write("run/evaluation.json", R"({"format": 1, "problems": 4, "tables": {}})");
  const ComparedRun run = read_compared_run(folder.path() / "run");
  CHECK(run.name == "run");
  CHECK(run.settings.size() == train::config_keys().size());
  CHECK(std::any_of(run.settings.begin(), run.settings.end(),
                    [](const Setting& setting) { return setting.name == "seed" && setting.value == "5"; }));
}
