#include "train/stages/evaluation_events.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "image/contact_sheet.h"
#include "io/events/event_file.h"
#include "predict/half_sphere_plot.h"
#include "train/metrics.h"
#include "train/view_sheet.h"

namespace svnet::train {
namespace {

constexpr SheetLayout kPanelLayout{.cell = 200, .gap = 4, .margin = 20, .text = 18, .font_size = 0.38};

/// The predicted and the true scores of a pose; empty if it has no true scores.
SheetGroup half_spheres(const Run& run, Index pose, std::span<const double> predicted, std::span<const double> scores) {
  std::vector<view::CameraPose> poses;
  std::vector<float> predictions, truth;
  const ViewDataset::Pose& views = run.dataset.poses[static_cast<std::size_t>(pose)];
  for (Index v = views.first_view; v < views.first_view + views.view_count; ++v) {
    const auto at = static_cast<std::size_t>(v);
    if (!std::isfinite(scores[at])) continue;
    const View& view = run.dataset.views[at];
    poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    predictions.push_back(static_cast<float>(predicted[at]));
    truth.push_back(static_cast<float>(scores[at]));
  }
  if (poses.empty()) return {};
  return {.cells = {{predict::half_sphere_plot(poses, predictions), "predicted"},
                    {predict::half_sphere_plot(poses, truth), "true"}},
          .title = run.dataset.pose_path(pose)};
}

/// The first objects of held-out categories, a line for each category.
std::optional<Image> panel(const Run& run, std::span<const double> predicted, std::span<const double> scores) {
  std::vector<SheetLine> lines;
  Index category = -1;
  for (const Index pose : sheet_poses(run.dataset, run.held_out)) {
    SheetGroup group = half_spheres(run, pose, predicted, scores);
    if (group.cells.empty()) continue;
    const Index here = run.dataset.poses[static_cast<std::size_t>(pose)].category;
    if (std::exchange(category, here) != here) lines.emplace_back();
    lines.back().groups.push_back(std::move(group));
  }
  if (lines.empty()) return {};
  return contact_sheet(lines, kPanelLayout);
}

}  // namespace

void write_evaluation_events(const Run& run, const EvaluationTables& tables, std::span<const double> predicted,
                             std::span<const double> scores) {
  io::EventFile events(run.folder, "evaluation");
  for (const auto& [split, table] : tables)
    for (std::size_t p = 0; p < table.pipelines.size(); ++p)
      for (std::size_t s = 0; s < table.selectors.size(); ++s)
        for (std::size_t m = 0; m < kMetrics.size(); ++m)
          events.add_scalar(joined(split, "/", table.pipelines[p], "/", table.selectors[s], "/", kMetrics[m].name), 0,
                            table.cells[p][s][m].mean);
  if (scores.empty()) return;
  if (const std::optional<Image> image = panel(run, predicted, scores))
    events.add_image("half-spheres of held-out objects: predicted and true scores", 0, *image);
}

}  // namespace svnet::train
