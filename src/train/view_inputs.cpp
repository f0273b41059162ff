#include "train/view_inputs.h"

#include <algorithm>

#include "base/parallel.h"
#include "io/images/image_file.h"
#include "train/dataset_rows.h"
#include "view/symmetry.h"

namespace svnet::train {
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

ImageInputs::ImageInputs(const ViewDataset& dataset, const models::Preprocessing& preprocessing,
                         std::shared_ptr<const Inference> frozen, const Options& options)
    : dataset_(dataset),
      preprocessing_(preprocessing),
      frozen_(std::move(frozen)),
      options_(options),
      kept_row_(dataset.views.size() * static_cast<std::size_t>(options.orientations), -1) {
  check(options.orientations == 1 || preprocessing.height == preprocessing.width, "[inputs] images of ",
        preprocessing.height, "x", preprocessing.width, " cannot be turned; only square ones can");
}

Shape ImageInputs::shape() const {
  const Shape shape = frozen_ ? frozen_->output_shape() : Shape{preprocessing_.height, preprocessing_.width, 3};
  return options_.flat ? Shape{element_count(shape)} : shape;
}

Tensor ImageInputs::compute(std::span<const Index> inputs) const {
  const auto count = static_cast<Index>(inputs.size());
  Tensor pixels = Tensor::empty({count, preprocessing_.height, preprocessing_.width, 3});
  // The image of a view is read once for all of its inputs that follow each other.
  Parallel::shared().for_chunks(count, options_.orientations, [&](Index begin, Index end, int) {
    std::vector<float> as_taken(static_cast<std::size_t>(preprocessing_.size()));
    for (Index i = begin, prepared = -1; i < end; ++i) {
      const Index input = inputs[static_cast<std::size_t>(i)], view = input / options_.orientations;
      if (view != prepared) {
        const auto& path = dataset_.views[static_cast<std::size_t>(view)].path;
        prepare(preprocessing_, io::read_image(dataset_.root / path, dataset_.exif_orientation), as_taken.data());
        prepared = view;
      }
      float* to = pixels.data<float>() + i * preprocessing_.size();
      const auto orientation = static_cast<int>(input % options_.orientations);
      if (orientation == 0)
        std::copy(as_taken.begin(), as_taken.end(), to);  // which need not be square
      else
        view::apply_symmetry(orientation, preprocessing_.width, as_taken.data(), to);
    }
  });
  return (frozen_ ? frozen_->run({pixels}) : pixels).reshaped(batched(count, shape()));
}

Tensor ImageInputs::batch(std::span<const Index> inputs) const {
  const auto row_of = [&](Index input) { return kept_row_[static_cast<std::size_t>(input)]; };
  if (!std::all_of(inputs.begin(), inputs.end(), [&](Index input) { return row_of(input) >= 0; }))
    return compute(inputs);
  const Index size = element_count(shape());
  Tensor batch = Tensor::empty(batched(static_cast<Index>(inputs.size()), shape()));
  for (std::size_t i = 0; i < inputs.size(); ++i)
    std::copy_n(kept_.data<float>() + row_of(inputs[i]) * size, size,
                batch.data<float>() + static_cast<Index>(i) * size);
  return batch;
}

void ImageInputs::keep(const std::vector<Index>& views, const Messages& messages, Communicator& communicator) {
  std::vector<Index> inputs;
  for (const Index view : views)
    for (int orientation = 0; orientation < options_.orientations; ++orientation)
      inputs.push_back(view * options_.orientations + orientation);
  const auto count = static_cast<Index>(inputs.size());
  const Index size = element_count(shape());
  Tensor kept = Tensor::zeros(batched(count, shape()));
  const Share share = share_of(communicator, 0, static_cast<std::uint64_t>((count + kBatch - 1) / kBatch));
  const Index first = static_cast<Index>(share.first) * kBatch;
  const Index last = std::min(count, static_cast<Index>(share.last) * kBatch);
  Progress progress(messages, "frozen layers", std::max<Index>(last - first, 0));
  for (Index begin = first; begin < last; begin += kBatch) {
    const Index end = std::min(begin + kBatch, last);
    const Tensor part =
        compute(std::span(inputs).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
    std::copy_n(part.data<float>(), part.size(), kept.data<float>() + begin * size);
    progress.update(end - first);
  }
  communicator.all_reduce({kept.data<float>(), static_cast<std::size_t>(kept.size())});
  kept_ = kept;
  std::fill(kept_row_.begin(), kept_row_.end(), -1);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    kept_row_[static_cast<std::size_t>(inputs[i])] = static_cast<Index>(i);
}

}  // namespace svnet::train
