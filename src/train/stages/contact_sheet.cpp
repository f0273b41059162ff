#include "train/stages/contact_sheet.h"

#include "io/images/image_file.h"
#include "train/stages/held_out_scores.h"
#include "train/view_sheet.h"
#include "train/view_targets.h"

namespace svnet::train {

std::optional<std::filesystem::path> contact_sheet_stage(const Run& run, const EvaluationInputs& inputs,
                                                         std::uint64_t problems) {
  if (!run.has_held_out_problems()) return {};
  const semantics::SemanticScores scores =
      inputs.held_out != nullptr ? *inputs.held_out : held_out_scores(run, inputs.features, problems);
  const auto& best = target_scores(scores, run.config.sv_net.target);
  const Selector selectors[] = {{"top", top_views(run.dataset)},
                                {"svnet", best_views(run.dataset, inputs.predicted)},
                                {"best", best_views(run.dataset, best)}};
  return write_contact_sheet(run, run.held_out, selectors);
}

std::filesystem::path write_contact_sheet(const Run& run, const std::vector<bool>& categories,
                                          std::span<const Selector> selectors) {
  std::filesystem::path path = run.folder / "views.png";
  io::write_png(path, view_sheet(run.dataset, sheet_poses(run.dataset, categories), selectors));
  return path;
}

}  // namespace svnet::train
