#include "report/poses_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.h"
#include "report/base64.h"
#include "report/markup.h"
#include "report/page.h"
#include "report/polar_map.h"

namespace svnet::report {
namespace {

constexpr std::size_t kMostRows = 2000;  // so that the page stays small

std::string pose_name(const ShownPose& pose) {
  return pose.category + ", object " + pose.object + ", pose " + pose.pose;
}

std::string angles(const ShownView& view) { return joined("θ ", view.theta_deg, "°, φ ", view.phi_deg, "°"); }

std::string score_words(const ShownView& view) {
  if (!std::isfinite(view.score)) return "not known";
  return number(view.score, 2) +
         (view.standard_error > 0 ? " ± " + number(view.standard_error, view.standard_error < 0.005 ? 3 : 2) : "");
}

std::string image_html(const Picture& picture, const std::string& alternative) {
  return empty_element("img", {{"src", "data:image/jpeg;base64," + base64(picture.jpeg)},
                               {"alt", alternative},
                               {"width", std::to_string(picture.width)},
                               {"height", std::to_string(picture.height)}});
}

/// The object's axis over an image of the top view: right is azimuth 180°, down is 90°.
std::string axis_overlay(const frame::ObjectAxis& axis, const Picture& picture) {
  if (axis.kind != frame::AxisKind::found) return "";
  const auto width = static_cast<double>(picture.width), height = static_cast<double>(picture.height);
  const double theta = axis.direction_deg * std::numbers::pi / 180, x = -std::cos(theta), y = std::sin(theta);
  const double half = std::min(width, height) * std::max(axis.length, 0.3) / 2 + 6, cx = width / 2, cy = height / 2;
  const double ex = cx + x * half, ey = cy + y * half;
  const auto line = [&](const char* style) { return svg_line(cx - x * half, cy - y * half, ex, ey, style); };
  const std::string head = "M" + coordinate(ex + x * 7) + " " + coordinate(ey + y * 7) + "L" +
                           coordinate(ex - y * 4.5) + " " + coordinate(ey + x * 4.5) + "L" + coordinate(ex + y * 4.5) +
                           " " + coordinate(ey - x * 4.5) + "Z";
  return element("svg",
                 {{"class", "overlay"},
                  {"aria-hidden", "true"},
                  {"viewBox", "0 0 " + coordinate(width) + " " + coordinate(height)}},
                 line("axis-halo") + line("axis-line") + empty_element("path", {{"d", head}, {"class", "axis-head"}}));
}

std::string axis_words(const frame::ObjectAxis& axis) {
  switch (axis.kind) {
    case frame::AxisKind::found:
      return "Its axis points to azimuth " + std::to_string(std::lround(axis.direction_deg) % 360) + "°.";
    case frame::AxisKind::round:
      return "No axis was found: it is about as wide as long.";
    case frame::AxisKind::unclear:
      return "No axis was found: the top view does not show one whole object.";
  }
  return "";
}

std::string shots_html(const ShownPose& pose) {
  if (!pose.pictures) return "";
  const auto shot = [&](std::size_t picture, const char* what, std::size_t view, const std::string& overlay) {
    const ShownView& shown = pose.views[view];
    return element(
        "figure",
        element("div", {{"class", "shot"}},
                image_html((*pose.pictures)[picture], joined(what, " of ", pose_name(pose), ": ", angles(shown))) +
                    overlay) +
            element("figcaption", element("strong", escaped(what)) + empty_element("br", {}) +
                                      escaped(score_words(shown)) + empty_element("br", {}) + escaped(angles(shown))));
  };
  std::string inner = shot(0, "Top view", pose.top, pose.axis ? axis_overlay(*pose.axis, (*pose.pictures)[0]) : "") +
                      shot(1, "SV-net's choice", pose.chosen, "");
  if (pose.best) inner += shot(2, "Best view", *pose.best, "");
  return element("div", {{"class", "shots"}}, inner) + "\n";
}

std::string half_sphere_html(const ShownPose& pose, const std::string& title, double ShownView::*score) {
  PolarMap map{
      .title = title, .alternative = {}, .views = {}, .chosen = pose.chosen, .best = pose.best, .worst = pose.worst};
  for (const ShownView& view : pose.views)
    map.views.push_back({{static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)}, view.*score});
  map.alternative = title + " of the views of " + pose_name(pose) + ". SV-net chose " + angles(pose.views[pose.chosen]);
  if (pose.best)
    map.alternative +=
        "; the best view is " + angles(pose.views[*pose.best]) + ", the worst " + angles(pose.views[*pose.worst]);
  map.alternative += ".";
  if (pose.axis && pose.axis->kind == frame::AxisKind::found) map.axis_deg = pose.axis->direction_deg;
  return polar_map(map);
}

std::string caption_words(const ShownPose& pose) {
  const ShownView &chosen = pose.views[pose.chosen], &top = pose.views[pose.top];
  std::string text = pose_name(pose) + ": SV-net chose " + angles(chosen) + ", true score " + number(chosen.score, 2) +
                     "; the top view has " + number(top.score, 2);
  if (pose.best)
    text += ", the best view (" + angles(pose.views[*pose.best]) + ") " + number(pose.views[*pose.best].score, 2) +
            ", a random view " + number(pose.mean_score, 2) + " on average";
  text += ".";
  return pose.axis ? text + " " + axis_words(*pose.axis) : text;
}

std::string figure_html(const ShownPose& pose, const std::string& id) {
  return element("article", {{"class", "pose"}, {"id", id}},
                 "\n" + element("h3", escaped(pose_name(pose))) + "\n" + shots_html(pose) +
                     element("div", {{"class", "maps"}},
                             half_sphere_html(pose, "Predicted scores", &ShownView::predicted) +
                                 half_sphere_html(pose, "True scores", &ShownView::score)) +
                     "\n" + element("p", {{"class", "caption"}}, escaped(caption_words(pose)))) +
         "\n";
}

std::string object_key(const ShownPose& pose) { return pose.category + "-" + pose.object; }

std::string table_row(const ShownPose& pose, const std::string& id) {
  const ShownView &chosen = pose.views[pose.chosen], &top = pose.views[pose.top];
  const auto view_cell = [&](const ShownView& view, std::size_t picture, const char* what) {
    std::string inner = escaped(number(view.score, 2));
    if (pose.pictures) inner = image_html((*pose.pictures)[picture], joined(what, " of ", pose_name(pose))) + inner;
    return element("td", {{"class", "left"}}, inner);
  };
  return element("tr", id.empty() ? Attributes{} : Attributes{{"id", id}},
                 element("th", {{"scope", "row"}}, escaped(pose.object)) +
                     element("td", {{"class", "left"}}, escaped(pose.pose)) +
                     element("td", {{"class", "left"}}, escaped(angles(chosen))) + view_cell(top, 0, "Top view") +
                     view_cell(chosen, 1, "SV-net's choice") +
                     (pose.best ? view_cell(pose.views[*pose.best], 2, "Best view") : element("td", "–")) +
                     element("td", escaped(number(pose.mean_score, 2)))) +
         "\n";
}

std::string category_html(const std::string& category, const std::string& rows, double chosen, double top) {
  std::string head;
  for (const char* title : {"Object", "Pose", "SV-net chose", "Top view", "SV-net's view", "Best view"})
    head += element("th", {{"scope", "col"}, {"class", "word"}}, title);
  head += element("th", {{"scope", "col"}}, "Random");
  return element("details", element("summary", element("strong", escaped(category)) +
                                                   escaped(" · chosen views " + number(chosen, 2) + ", top views " +
                                                           number(top, 2))) +
                                table_html("Views of " + category,
                                           element("thead", element("tr", head)) + element("tbody", "\n" + rows))) +
         "\n";
}

}  // namespace

std::string pose_figures_html(const RunReport& report, Ids& ids) {
  std::string figures;
  for (const ShownPose& pose : report.poses)
    if (pose.axis) figures += figure_html(pose, ids.make(object_key(pose)));
  if (figures.empty()) return "";
  return how_to_read(joined(
             "The maps show the half-sphere of camera poses as it lies in the top image: the centre is the top view, "
             "the rim the lowest elevation φ, and the numbers around it are azimuths θ. Yellow is the highest score of "
             "the map, dark blue the lowest; predicted scores have a scale of their own.")) +
         how_to_read(joined("A white dot marks SV-net's choice, a solid green outline the view with the best true ",
                            report.target,
                            " score, a dashed red one the worst. The dotted line is the object's axis; in "
                            "the picture its arrow points to the heavy end. ± is the standard error of a score.")) +
         element("div", {{"class", "poses"}}, "\n" + figures) + "\n";
}

std::string pose_table_html(const RunReport& report, Ids& ids) {
  std::set<std::string> named;
  for (const ShownPose& pose : report.poses)
    if (pose.axis) named.insert(object_key(pose));
  std::string html, rows;
  double chosen = 0, top = 0, count = 0;
  const std::size_t shown = std::min(report.poses.size(), kMostRows);
  for (std::size_t p = 0; p < shown; ++p) {
    const ShownPose& pose = report.poses[p];
    rows += table_row(pose, named.insert(object_key(pose)).second ? ids.make(object_key(pose)) : "");
    if (const double a = pose.views[pose.chosen].score, b = pose.views[pose.top].score;
        std::isfinite(a) && std::isfinite(b))
      chosen += a, top += b, ++count;
    if (p + 1 < shown && report.poses[p + 1].category == pose.category) continue;
    html += category_html(pose.category, rows, chosen / count, top / count);
    rows.clear();
    chosen = top = count = 0;
  }
  if (html.empty()) return "";
  return how_to_read(
             "Open a category to see every pose: the view that SV-net chose, and the true scores of the top view, of "
             "this choice, of the best view, and of a random view on average. The first pose of each object has "
             "pictures.") +
         html +
         (shown < report.poses.size() ? how_to_read(joined("The first ", shown, " of ", report.poses.size(),
                                                           " poses are listed; predictions.json has all."))
                                      : "");
}

}  // namespace svnet::report
