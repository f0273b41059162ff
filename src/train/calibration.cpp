#include "train/calibration.h"

#include <algorithm>

#include "nn/runtime/calibration.h"

namespace svnet::train {

BackboneWithOrigin calibrated(const BackboneWithOrigin& from, const ViewDataset& dataset, Index images,
                              const Messages& messages) {
  const models::Backbone& backbone = from.backbone;
  const auto views = static_cast<Index>(dataset.views.size()), count = std::min(images, views);
  check(count > 0, "[calibration] there are no pictures");
  Calibration calibration(backbone.graph(), backbone.parameters(), backbone.graph().output());
  Progress progress(messages, "ranges of " + backbone.kind().name, count);
  for (Index i = 0; i < count; ++i) {
    const Index view = i * views / count;
    calibration.add(prepared_views(backbone.preprocessing(), dataset, view, view + 1, Parallel::shared()));
    progress.update(i + 1);
  }
  return {models::in_int8(backbone, std::make_shared<ActivationRanges>(calibration.ranges())), from.weights};
}

}  // namespace svnet::train
