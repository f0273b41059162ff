#pragma once
#include <span>
#include <vector>

#include "base/progress.h"
#include "data/view_dataset.h"
#include "models/preprocessing.h"
#include "nn/tensor.h"
#include "train/augmentation.h"

namespace svnet {

/// Pictures of a dataset in memory, at the size that a network takes, each with its class.
class LabelledPictures {
 public:
  struct Picture {
    Index view;    // of the dataset
    Index number;  // the class
  };

  /// Reads the pictures. Throws Error that names the file where one cannot be read.
  LabelledPictures(const ViewDataset& dataset, std::vector<Picture> pictures, const Preprocessing& preprocessing,
                   const Messages& messages, const std::string& task);

  Index size() const { return static_cast<Index>(images_.size()); }

  struct Batch {
    Tensor pixels;  // (B, H, W, 3), preprocessed
    std::vector<Index> classes;
  };
  /// The pictures as they are.
  Batch batch(std::span<const std::int32_t> numbers) const;
  /// The pictures as they are changed in an epoch: by the seed, the epoch and the picture's number alone.
  Batch augmented_batch(std::span<const std::int32_t> numbers, const Augmentation& how, std::uint64_t seed,
                        Index epoch) const;

 private:
  template <class Change>
  Batch batch_of(std::span<const std::int32_t> numbers, const Change& change) const;

  Preprocessing preprocessing_;
  std::vector<Image> images_;
  std::vector<Index> classes_;
};

}  // namespace svnet
