#pragma once
#include <span>
#include <vector>

#include "base/progress.h"
#include "data/view_dataset.h"
#include "models/preprocessing.h"
#include "nn/tensor.h"
#include "train/augmentation.h"

namespace svnet::train {

/// Images of a dataset in memory, at the size that a network takes, each with its class.
class LabelledImages {
 public:
  struct Example {
    Index view;   // of the dataset
    Index label;  // the class
  };

  /// Reads the images. Throws Error, with the name of the file, if one cannot be read.
  LabelledImages(const ViewDataset& dataset, std::vector<Example> examples, const models::Preprocessing& preprocessing,
                 const Messages& messages, const std::string& task);

  Index size() const { return static_cast<Index>(images_.size()); }

  struct Batch {
    Tensor pixels;  // (B, H, W, 3), preprocessed
    std::vector<Index> classes;
  };
  /// The images as they are.
  Batch batch(std::span<const std::int32_t> indices) const;
  /// The images as they are changed at random in an epoch. The changes depend on the seed, the epoch and the index of
  /// the image only.
  Batch augmented_batch(std::span<const std::int32_t> indices, const Augmentation& how, std::uint64_t seed,
                        Index epoch) const;

 private:
  template <class Change>
  Batch batch_of(std::span<const std::int32_t> indices, const Change& change) const;

  models::Preprocessing preprocessing_;
  std::vector<Image> images_;
  std::vector<Index> classes_;
};

}  // namespace svnet::train
