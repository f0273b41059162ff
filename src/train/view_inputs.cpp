#include "train/view_inputs.h"

#include <algorithm>

#include "base/parallel.h"
#include "io/image_file.h"
#include "train/training_set.h"

namespace svnet {
namespace {

constexpr Index kBatch = 16;

Shape batched(Index count, Shape shape) {
  shape.insert(shape.begin(), count);
  return shape;
}

}  // namespace

FeatureInputs::FeatureInputs(const ViewDataset& dataset, const Features& features) : features_(features) {
  check_rows(dataset, features.paths, "features");
}

Tensor FeatureInputs::batch(std::span<const Index> views) const {
  const Index size = features_.dimension;
  Tensor batch = Tensor::empty({static_cast<Index>(views.size()), size});
  for (std::size_t i = 0; i < views.size(); ++i)
    std::copy_n(features_.values.data() + views[i] * size, size, batch.data<float>() + static_cast<Index>(i) * size);
  return batch;
}

PictureInputs::PictureInputs(const ViewDataset& dataset, const Preprocessing& preprocessing,
                             std::shared_ptr<const Inference> frozen)
    : dataset_(dataset),
      preprocessing_(preprocessing),
      frozen_(std::move(frozen)),
      kept_row_(dataset.views.size(), -1) {}

Shape PictureInputs::shape() const {
  return frozen_ ? frozen_->output_shape() : Shape{preprocessing_.height, preprocessing_.width, 3};
}

Tensor PictureInputs::made(std::span<const Index> views) const {
  const auto count = static_cast<Index>(views.size());
  Tensor pixels = Tensor::empty({count, preprocessing_.height, preprocessing_.width, 3});
  Parallel::shared().for_chunks(count, 1, [&](Index i, Index, int) {
    const View& view = dataset_.views[static_cast<std::size_t>(views[static_cast<std::size_t>(i)])];
    prepare(preprocessing_, read_image(dataset_.root / view.path), pixels.data<float>() + i * preprocessing_.size());
  });
  return frozen_ ? frozen_->run({pixels}) : pixels;
}

Tensor PictureInputs::batch(std::span<const Index> views) const {
  const auto row_of = [&](Index view) { return kept_row_[static_cast<std::size_t>(view)]; };
  if (!std::all_of(views.begin(), views.end(), [&](Index view) { return row_of(view) >= 0; })) return made(views);
  const Index size = element_count(shape());
  Tensor batch = Tensor::empty(batched(static_cast<Index>(views.size()), shape()));
  for (std::size_t i = 0; i < views.size(); ++i)
    std::copy_n(kept_.data<float>() + row_of(views[i]) * size, size,
                batch.data<float>() + static_cast<Index>(i) * size);
  return batch;
}

void PictureInputs::keep(const std::vector<Index>& views, const Messages& messages, Team& team) {
  const auto count = static_cast<Index>(views.size());
  const Index size = element_count(shape());
  Tensor kept = Tensor::zeros(batched(count, shape()));
  const Share share = share_of(team, 0, static_cast<std::uint64_t>((count + kBatch - 1) / kBatch));
  const Index first = static_cast<Index>(share.first) * kBatch;
  const Index last = std::min(count, static_cast<Index>(share.last) * kBatch);
  Progress progress(messages, "frozen layers", std::max<Index>(last - first, 0));
  for (Index begin = first; begin < last; begin += kBatch) {
    const Index end = std::min(begin + kBatch, last);
    const Tensor part =
        made(std::span(views).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
    std::copy_n(part.data<float>(), part.size(), kept.data<float>() + begin * size);
    progress.update(end - first);
  }
  team.gather({kept.data<float>(), static_cast<std::size_t>(kept.size())});
  kept_ = kept;
  std::fill(kept_row_.begin(), kept_row_.end(), -1);
  for (std::size_t i = 0; i < views.size(); ++i) kept_row_[static_cast<std::size_t>(views[i])] = static_cast<Index>(i);
}

}  // namespace svnet
