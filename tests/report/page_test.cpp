// The page of a run answers the questions that a reader has, by itself.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "report/write_report.h"
#include "small_report.h"

using namespace svnet::report;
using Catch::Contains;

namespace {

std::vector<std::string> attributes(const std::string& html, const std::string& name) {
  const std::regex pattern(" " + name + "=\"([^\"]*)\"");
  std::vector<std::string> values;
  for (std::sregex_iterator i(html.begin(), html.end(), pattern), end; i != end; ++i) values.push_back((*i)[1]);
  return values;
}

}  // namespace

TEST_CASE("the page says what SV-net chose for the third mug, and what other views score") {
  const std::string html = report_html(small_report());
  CHECK_THAT(html, Contains("id=\"mug-3\""));
  CHECK_THAT(html, Contains("mug, object 3, pose 1: SV-net chose θ 90°, φ 45°, true score 0.61; the top view has 0.48, "
                            "the best view (θ 0°, φ 60°) 0.66, a random view 0.52 on average."));
  CHECK_THAT(html, Contains("alt=\"Top view of mug, object 3, pose 1: θ 90°, φ 90°\""));
  CHECK_THAT(html, Contains("Its axis points to azimuth 30°."));
}

TEST_CASE("the page says how sure the lead over random views is, and what another seed would change") {
  const std::string html = report_html(small_report());
  CHECK_THAT(html, Contains("Against random views, the views that it chose raise the Fowlkes–Mallows index (FM) of the "
                            "clustering by 0.061 (95 % interval over categories: +0.035 to +0.088); this is sure, as "
                            "the interval excludes 0."));
  CHECK_THAT(html, Contains("this is not sure, as the interval includes 0"));
  CHECK_THAT(html, Contains("What another seed would change: it would draw other clustering problems."));
  CHECK_THAT(html, Contains("The head is fitted in closed form, from no random start"));
  CHECK_THAT(html, Contains("one run cannot say: repeat it with --set seed=N"));
  CHECK_THAT(html, Contains("chosen view scores higher than the top view in 100 % of 6 poses"));
}

TEST_CASE("random weights are the first thing that the page says") {
  RunReport report = small_report();
  CHECK_THAT(report_html(report), !Contains("Random weights"));
  report.random_backbones = {"vgg19"};
  const std::string html = report_html(report);
  CHECK(html.find("Random weights: vgg19.") < html.find("SV-net learnt from"));
}

TEST_CASE("the page stands alone: it has no scripts and names nothing outside") {
  const std::string html = report_html(small_report());
  CHECK_THAT(html, !Contains("http") && !Contains("<script") && !Contains("url(") && !Contains("@import"));
  for (const std::string& source : attributes(html, "src")) CHECK(source.starts_with("data:image/jpeg;base64,"));
  for (const std::string& target : attributes(html, "href")) CHECK(target.starts_with("#"));
}

TEST_CASE("names from folders are escaped everywhere") {
  const std::string html = report_html(small_report());
  CHECK_THAT(html, !Contains("<b>"));
  CHECK_THAT(html, Contains("&lt;b&gt;&quot;pen&quot;&lt;/b&gt;, object 1"));
}

TEST_CASE("ids are unique, links have targets, and every image has an alternative text") {
  const std::string html = report_html(small_report());
  const std::vector<std::string> ids = attributes(html, "id");
  const std::set<std::string> unique(ids.begin(), ids.end());
  CHECK(unique.size() == ids.size());
  for (const char* object : {"mug-1", "mug-2", "mug-3"}) CHECK(unique.count(object) == 1);
  for (const std::string& target : attributes(html, "href")) CHECK(unique.count(target.substr(1)) == 1);
  for (const std::string& tag : {std::string("<img "), std::string("<svg ")}) {
    for (std::size_t at = html.find(tag); at != std::string::npos; at = html.find(tag, at + 1)) {
      const std::string attributes_of = html.substr(at, html.find('>', at) - at);
      INFO(attributes_of);
      CHECK((attributes_of.find(" alt=\"") != std::string::npos ||
             attributes_of.find("aria-label=\"") != std::string::npos ||
             attributes_of.find("aria-hidden=\"true\"") != std::string::npos));
    }
  }
}

TEST_CASE("headings have one h1 and skip no level") {
  const std::string html = report_html(small_report());
  const std::regex heading("<h([1-6])");
  int before = 0, first = 0;
  for (std::sregex_iterator i(html.begin(), html.end(), heading), end; i != end; ++i) {
    const int level = std::stoi((*i)[1]);
    CHECK(level <= before + 1);
    first += level == 1 ? 1 : 0;
    before = level;
  }
  CHECK(first == 1);
}

TEST_CASE("sections without contents are left out, and heads without epochs say so") {
  RunReport report = small_report();
  CHECK_THAT(report_html(report), !Contains("Time per stage") && !Contains("Map of features") &&
                                      Contains("fitted in closed form, by ridge regression: there are no epochs"));
  report.times = {{"features mobilenet_v2", 12.3, false}, {"SV-net", 0.84, true}, {"scores", 125, false}};
  report.curves = TrainingCurves{{0.5, 0.4}, {}, {}, {}};
  const std::string html = report_html(report);
  CHECK_THAT(html, Contains("12.3 s") && Contains("0.8 s") && Contains("2 min 5 s") && Contains("reused"));
  CHECK_THAT(html, Contains("<polyline"));
}

TEST_CASE("without held-out categories the page says that it cannot tell") {
  RunReport report = small_report();
  report.poses.clear();
  report.tables.front().held_out = false;
  report.tables.front().leads.clear();
  CHECK_THAT(report_html(report), Contains("Fewer than two categories were held out"));
}

TEST_CASE("a page of the paper's size is smaller than 5 MB") {
  RunReport report = small_report();
  ShownPose pose = report.poses.front();
  pose.axis.reset();
  report.poses.clear();
  for (int category = 0; category < 29; ++category)
    for (int object = 1; object <= 5; ++object)
      for (int p = 1; p <= 3; ++p) {
        pose.category = "category_" + std::to_string(category);
        pose.object = std::to_string(object);
        pose.pose = std::to_string(p);
        pose.pictures.reset();
        if (p == 1)
          pose.pictures = {
              {{std::string(3000, 'x'), 88, 88}, {std::string(3000, 'x'), 88, 88}, {std::string(3000, 'x'), 88, 88}}};
        report.poses.push_back(pose);
      }
  CHECK(report_html(report).size() < 5'000'000);
}

TEST_CASE("a table with shares of moves has their curve") {
  RunReport report = small_report();
  const auto page = [&] { return report_html(report); };
  CHECK_THAT(page(), !Contains("Moving only where it pays"));
  Table& table = report.tables[0];
  table.selectors = {"top", "move_25", "move_50", "move_75", "svnet"};
  for (auto& row : table.cells) row.resize(5, row[0]);
  CHECK_THAT(page(),
             Contains("Moving only where it pays") && Contains("by the share of poses in which the camera moved"));
}
