#include "info/describe_model.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "frame/frame_words.h"

namespace svnet {
namespace {

std::string input_text(const Model& model) {
  std::string text = "an RGB image of the object from above, of any size";
  if (model.depth != frame::DepthChoice::none) text += ", and its depth image";
  return text;
}

std::string preprocessing_text(const models::Preprocessing& p) {
  return joined(p.height, "x", p.width, ", ", name_of(p.interpolation), ", pixels as ", name_of(p.mode));
}

std::string head_text(const Model& model) {
  const Index parameters = model.head.parameter_count();
  if (model.frame == frame::FrameChoice::camera)
    return joined("network, ", parameters, " parameters",
                  model.symmetries > 1 ? ", mean over the orientations of the image" : "");
  const bool is_linear =
      std::ranges::none_of(model.head.nodes(), [](const GraphNode& node) { return node.name == "mean"; });
  return joined(is_linear ? "ridge regression" : "networks, averaged", " on ", frame::input_count(frame_spec(model)),
                " inputs of the object and the camera pose, ", parameters, " parameters");
}

std::string trained_on_text(const TrainedOn& on) {
  if (on.categories.empty()) return "not known: the model was made by an earlier version";
  return joined(on.top_views, " top views of ", on.objects, " objects in ", on.categories.size(),
                " categories: ", printable(joined_with(", ", on.categories)));
}

/// A line per pipeline: the means of all metrics for each selector.
std::vector<std::string> held_out_lines(const HeldOutResults& results) {
  if (results.values.empty()) return {"not known: no categories were held out, or svnet-eval was not run"};
  std::vector<std::string> metrics,
      lines{joined("on ", results.categories.size(), " categories held out (",
                   printable(joined_with(", ", results.categories)), "), ", results.problems, " problems")};
  std::map<std::string, std::map<std::string, std::string>> cells;  // by pipeline and selector
  for (const auto& value : results.values) {
    if (std::ranges::find(metrics, value.metric) == metrics.end()) metrics.push_back(value.metric);
    std::string& cell = cells[value.pipeline][value.selector];
    std::ostringstream number;
    number << std::fixed << std::setprecision(3) << value.mean;
    cell += (cell.empty() ? "" : " / ") + number.str();
  }
  lines.push_back("means of " + printable(joined_with(" / ", metrics)) + " by the views of each selector:");
  for (const auto& [pipeline, selectors] : cells) {
    std::string line = printable(pipeline) + ":";
    for (const auto& [selector, cell] : selectors) line += "  " + printable(selector) + " " + cell;
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::string description_of(const Model& model) {
  std::ostringstream text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text << "\n  " << name << std::string(14 - name.size(), ' ') << value;
  };
  text << "SV-net, a trained model: scores camera poses, 0 to 1, higher shows more of the object";
  line("takes", input_text(model));
  line("frame", joined(name_of(model.frame), ": ", frame::words_of(model.frame)));
  if (frame::has_axis(model.frame)) line("depth", name_of(model.depth));
  if (frame::has_backbone(model.frame)) {
    line("backbone", printable(model.backbone) + ", layer " + printable(model.backbone_output));
    line("preprocessing", preprocessing_text(model.preprocessing));
  }
  line("head", head_text(model));
  line("weights", name_of(model.precision));
  line("angles", "theta, the azimuth, and phi, the elevation of the camera, in degrees; (90, 90) is the top view");
  line("trained on", trained_on_text(model.trained_on));
  const std::vector<std::string> reached = held_out_lines(model.held_out);
  for (std::size_t i = 0; i < reached.size(); ++i) line(i == 0 ? "reached" : "", reached[i]);
  if (!model.seen.mean.empty())
    line("shapes", joined("up to ", model.seen.limit,
                          " standard deviations from their mean; of a shape farther away, the "
                          "terms of the shape count less"));
  line("fingerprint", printable(model.input_fingerprint));
  return text.str();
}

}  // namespace svnet
