// svnet-report, and the pages that svnet-eval and svnet-crossval write.
#include <catch2/catch.hpp>

#include "bar_place.h"

using namespace svnet;
using Catch::Contains;

namespace {

const std::string kCrossval = "svnet-crossval config.yaml --threads 1 --quiet --folds 3 --output run ";

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n') + 1;
  return text.substr(text.rfind('\n', end - 1) + 1, end - text.rfind('\n', end - 1) - 1);
}

}  // namespace

TEST_CASE("svnet-crossval writes the page of its folder, and svnet-report makes the same again") {
  const BarPlace place;
  CHECK(last_line(place.output_of(kCrossval)) == "Report: run/report.html");
  const std::string page = file_contents(place.folder.path() / "run/report.html");
  CHECK(page.size() < 5'000'000);
  CHECK_THAT(page, Contains("In each of 3 folds SV-net learnt") && Contains("id=\"awl-1\"") &&
                       Contains("SV-net chose θ ") && Contains("Fold by fold") && Contains("src=\"data:image/jpeg;"));
  CHECK_THAT(page, !Contains("http") && !Contains("Random weights"));

  CHECK(place.output_of("svnet-report run --quiet") == "Report: run/report.html\n");
  CHECK(file_contents(place.folder.path() / "run/report.html") == page);
  CHECK(place.output_of("svnet-report run --quiet --output elsewhere.html") == "Report: elsewhere.html\n");
  CHECK(file_contents(place.folder.path() / "elsewhere.html") == page);
  place.output_of("mv data photos");
  CHECK_THAT(place.error_of("svnet-report run"), Contains("data: no such folder; if the data set was moved"));
  place.output_of("svnet-report run --quiet --set dataset.root=photos");
  CHECK_THAT(file_contents(place.folder.path() / "run/report.html"), Contains("photos: 6 categories"));
}

TEST_CASE("svnet-eval writes the page of a run, and says where") {
  const BarPlace place;
  place.output_of("svnet-train config.yaml --output run --threads 1 --quiet --set dataset.held_out=[peg,rod]");
  CHECK(last_line(place.output_of("svnet-eval run --threads 1 --quiet")) == "Report: run/report.html");
  const std::string page = file_contents(place.folder.path() / "run/report.html");
  CHECK_THAT(page, Contains("SV-net learnt from 4 categories") && Contains("id=\"peg-1\"") &&
                       Contains("id=\"rod-1\"") && !Contains("id=\"awl-1\"") && Contains("Training categories") &&
                       Contains("there are too few categories for an interval"));
  CHECK_THAT(place.output_of("svnet-eval run --threads 1 --quiet --json /dev/stdout"), !Contains("Report: "));
  const Ran open = place.run("unset DISPLAY WAYLAND_DISPLAY; svnet-eval run --threads 1 --open");
  CHECK(open.status == 0);
  CHECK_THAT(open.err, Contains("There is no desktop here, and so no browser; open /") && Contains("run/report.html"));
}

TEST_CASE("a run that holds nothing out has a page that says so") {
  const BarPlace place;
  place.output_of("svnet-train config.yaml --output run --threads 1 --quiet");
  place.output_of("svnet-eval run --threads 1 --quiet");
  CHECK_THAT(file_contents(place.folder.path() / "run/report.html"),
             Contains("Fewer than two categories were held out") && !Contains("Poses in detail"));
}

TEST_CASE("svnet-report shows several runs side by side") {
  const BarPlace place;
  place.output_of(kCrossval);
  place.output_of(
      "svnet-crossval config.yaml --threads 1 --quiet --folds 3 --output other --set seed=4 --set dataset.root=data");
  CHECK(place.output_of("svnet-report run other --quiet") == "Report: comparison.html\n");
  const std::string page = file_contents(place.folder.path() / "comparison.html");
  CHECK_THAT(page, Contains(">seed<") && !Contains(">sv_net.width<") && Contains(">run<") && Contains(">other<"));
  CHECK(place.run("svnet-report run other --set seed=1").status == 2);
  CHECK(place.run("svnet-report").status == 2);
}

TEST_CASE("svnet-report names what is missing or damaged, and leaves the page as it was") {
  const BarPlace place;
  CHECK_THAT(place.error_of("svnet-report run"), Contains("run: no such run folder"));
  place.output_of("mkdir empty");
  CHECK_THAT(place.error_of("svnet-report empty"), Contains("empty: is no run folder, it has no config.yaml"));
  place.output_of(kCrossval);
  const std::string page = file_contents(place.folder.path() / "run/report.html");
  for (const char* file : {"evaluation.json", "crossval.json", "predictions.json", "features-tiny_xception.h5"}) {
    place.output_of(std::string("mv run/") + file + " kept");
    CHECK_THAT(place.error_of("svnet-report run"),
               Contains(std::string("run/") + file + ": no such file; run svnet-eval"));
    place.output_of(std::string("head -c 40 kept >run/") + file);
    CHECK_THAT(place.error_of("svnet-report run"), Contains(std::string("run/") + file));
    place.output_of(std::string("mv kept run/") + file);
  }
  place.output_of("cp data/awl/1/1/90_90.png kept; head -c 40 kept >data/awl/1/1/90_90.png");
  CHECK_THAT(place.error_of("svnet-report run"), Contains("awl/1/1/90_90.png"));
  place.output_of("mv kept data/awl/1/1/90_90.png");
  CHECK_THAT(place.error_of("svnet-report run --output run/config.yaml"), Contains("run/config.yaml"));
  CHECK_THAT(place.error_of("svnet-report run --output none/page.html"), Contains("none/page.html"));
  CHECK(place.output_of("svnet-report run --quiet --output /dev/stdout | cat") == page);
  CHECK_THAT(place.error_of("svnet-report run empty"), Contains("empty: is no run folder"));
  CHECK_FALSE(std::filesystem::exists(place.folder.path() / "comparison.html"));
  CHECK(file_contents(place.folder.path() / "run/report.html") == page);
}

TEST_CASE("random weights are the first thing on the page") {
  const BarPlace place;
  place.output_of(kCrossval + "--set scores.backbone=mobilenet_v2 --set evaluation.pipelines=[mobilenet_v2_ward]");
  const std::string page = file_contents(place.folder.path() / "run/report.html");
  CHECK(page.find("Random weights: mobilenet_v2.") < page.find("In each of 3 folds"));
}
