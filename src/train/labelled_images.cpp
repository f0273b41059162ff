#include "train/labelled_images.h"

#include "base/parallel.h"
#include "io/images/image_file.h"

namespace svnet::train {

LabelledImages::LabelledImages(const ViewDataset& dataset, std::vector<Example> examples,
                               const models::Preprocessing& preprocessing, const Messages& messages,
                               const std::string& task)
    : preprocessing_(preprocessing), images_(examples.size()) {
  constexpr Index kBlock = 256;  // between two reports
  Progress progress(messages, task, size());
  for (Index first = 0; first < size(); first += kBlock) {
    const Index count = std::min(kBlock, size() - first);
    Parallel::shared().for_chunks(count, 1, [&](Index begin, Index, int) {
      const auto i = static_cast<std::size_t>(first + begin);
      const View& view = dataset.views[static_cast<std::size_t>(examples[i].view)];
      images_[i] = resized(io::read_image(dataset.root / view.path, dataset.exif_orientation), preprocessing.height,
                           preprocessing.width, preprocessing.interpolation);
    });
    progress.update(first + count);
  }
  for (const Example& example : examples) classes_.push_back(example.label);
}

template <class Change>
LabelledImages::Batch LabelledImages::batch_of(std::span<const std::int32_t> indices, const Change& change) const {
  Batch batch{Tensor::empty({static_cast<Index>(indices.size()), preprocessing_.height, preprocessing_.width, 3}), {}};
  float* to = batch.pixels.data<float>();
  Parallel::shared().for_chunks(static_cast<Index>(indices.size()), 1, [&](Index i, Index, int) {
    const auto index = static_cast<std::size_t>(indices[static_cast<std::size_t>(i)]);
    prepare(preprocessing_, change(images_[index], index), to + i * preprocessing_.size());
  });
  for (const std::int32_t index : indices) batch.classes.push_back(classes_[static_cast<std::size_t>(index)]);
  return batch;
}

LabelledImages::Batch LabelledImages::batch(std::span<const std::int32_t> indices) const {
  return batch_of(indices, [](const Image& image, std::size_t) -> const Image& { return image; });
}

LabelledImages::Batch LabelledImages::augmented_batch(std::span<const std::int32_t> indices, const Augmentation& how,
                                                      std::uint64_t seed, Index epoch) const {
  return batch_of(indices, [&](const Image& image, std::size_t index) {
    RandomStream random(seed, Stream::augmentation, static_cast<std::uint64_t>(epoch) << 32 | index);
    return augmented(image, how, random);
  });
}

}  // namespace svnet::train
