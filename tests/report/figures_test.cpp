// Each figure says in words what it shows.
#include <catch2/catch.hpp>
#include <cmath>

#include "report/box_plot.h"
#include "report/dot_plot.h"
#include "report/line_chart.h"
#include "report/polar_map.h"
#include "report/scatter.h"

using namespace svnet::report;
using Catch::Contains;

namespace {

const double kNone = std::nan("");

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// What a browser reads out for an image.
std::string alternative_of(const std::string& svg) {
  REQUIRE_THAT(svg, Contains("<svg role=\"img\" aria-label=\""));
  const std::size_t begin = svg.find("aria-label=\"") + 12;
  return svg.substr(begin, svg.find('"', begin) - begin);
}

}  // namespace

TEST_CASE("a dot plot tells every value with its interval, and hollow dots are not sure") {
  const std::string svg = dot_plot({.title = "FM",
                                    .alternative = "SV-net minus others",
                                    .rows = {{.label = "over <random>"},
                                             {.label = "ward", .value = {0.06, 0.03, 0.09}, .stands_out = true},
                                             {.label = "kmeans", .value = {0.01, -0.02, 0.04}},
                                             {.label = "single", .value = {0.01, kNone, kNone}}},
                                    .differences = true});
  const std::string words = alternative_of(svg);
  CHECK_THAT(words, Contains("SV-net minus others") && Contains("ward: +0.060 [+0.030, +0.090]") &&
                        Contains("kmeans: +0.010 [−0.020, +0.040]") && Contains("over &lt;random&gt;"));
  CHECK(count(svg, "hollow") == 2);
  CHECK(count(svg, "class=\"zero\"") == 1);
  CHECK(dot_plot({.title = "FM", .alternative = "", .rows = {{.label = "nothing"}}}).empty());
}

TEST_CASE("a polar map has a cell per view and marks the choice, the best and the worst") {
  PolarMap map{
      .title = "True scores", .alternative = "True scores of mug", .views = {}, .chosen = 1, .best = 2, .worst = 0};
  map.views.push_back({{90, 90}, 0.2});
  for (const double phi : {45, 60, 75})
    for (const double theta : {0, 45, 90, 135, 180, 225, 315}) map.views.push_back({{theta, phi}, 0.3 + theta / 1000});
  map.views.back().score = kNone;
  const std::string svg = polar_map(map);
  CHECK(alternative_of(svg) == "True scores of mug");
  CHECK(count(svg, "<title>θ ") == 22);
  CHECK(count(svg, "class=\"unknown\"") == 1);
  CHECK(count(svg, "class=\"mark best\"") == 1);
  CHECK(count(svg, "class=\"mark worst\"") == 1);
  CHECK(count(svg, "class=\"chosen\"") == 1);
  for (const char* label : {">0°<", ">90°<", ">180°<", ">270°<", ">φ 45<"}) CHECK_THAT(svg, Contains(label));
  CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
}

TEST_CASE("a polar map of one view, or of equal scores, is drawn") {
  CHECK_THAT(polar_map({.title = "t", .alternative = "a", .views = {{{90, 90}, 0.5}}}), !Contains("nan"));
  CHECK_THAT(polar_map({.title = "t", .alternative = "a", .views = {{{0, 10}, 0.5}, {{0, 20}, 0.5}}}),
             !Contains("nan") && Contains("#fde725"));
}

TEST_CASE("a line chart says where each line begins and ends, and has no figure without values") {
  const std::string svg = line_chart({"Loss", {{"training", {0.5, 0.4, 0.25}}, {"validation", {kNone, kNone, kNone}}}});
  CHECK_THAT(alternative_of(svg), Contains("training: from 0.500 to 0.250") && !Contains("validation"));
  CHECK(count(svg, "<polyline") == 1);
  CHECK(line_chart({"Loss", {{"training", {kNone}}}}).empty());
  CHECK_THAT(line_chart({"Loss", {{"training", {0.5}}}}), !Contains("nan"));
  const std::string moves = line_chart({.title = "FM",
                                        .lines = {{"mobilenet_v2_kmeans", {0.5, 0.6}}},
                                        .first = "0 % moved",
                                        .last = "100 %",
                                        .along = "by share",
                                        .long_labels = true});
  CHECK_THAT(moves, Contains(">mobilenet_v2_kmeans<") && Contains(">0 % moved<") && Contains(">100 %<"));
  CHECK_THAT(alternative_of(moves), Contains("FM by share. mobilenet_v2_kmeans: from 0.500 to 0.600"));
}

TEST_CASE("boxes are quantiles") {
  const Box box = box_of({4, 1, 3, 2, 5});
  CHECK(box.median == 3);
  CHECK(box.first_quartile == 2);
  CHECK(box.high == Approx(4.8));
  const std::string svg = box_plot("Scores", std::vector<BoxRow>{{"mug", box, 4.5, kNone}});
  CHECK_THAT(alternative_of(svg), Contains("mug: median 3.00, SV-net&#39;s choices 4.50.") && !Contains("top views"));
}

TEST_CASE("48 groups have markers of their own") {
  std::vector<std::string> groups(48, "g");
  const std::string legend = scatter_legend(groups);
  std::vector<std::string> markers;
  for (std::size_t at = legend.find("viewBox"); at != std::string::npos; at = legend.find("viewBox", at + 1))
    markers.push_back(legend.substr(at, legend.find("</svg>", at) - at));
  REQUIRE(markers.size() == 48);
  std::sort(markers.begin(), markers.end());
  CHECK(std::unique(markers.begin(), markers.end()) == markers.end());
  const std::string svg =
      scatter({.title = "Top views", .alternative = "a map", .points = {{0, 0, 0}, {1, 2, 9}}, .limits = {0, 1, 0, 2}});
  CHECK(alternative_of(svg) == "a map");
}
