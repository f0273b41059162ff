#pragma once
#include <limits>
#include <string>
#include <vector>

#include "base/progress.h"
#include "data/view_dataset.h"
#include "models/backbone.h"
#include "train/augmentation.h"

namespace svnet {

struct PretrainingOptions {
  std::string backbone = "tiny_xception";
  std::vector<std::string> exclude;  ///< categories that take no part
  Index validation_objects = 1;      ///< the last so many objects of each category, which are not trained on
  Index epochs = 30;
  Index batch_size = 32;
  double learning_rate = 2e-3;  ///< the highest: after a warm-up of at most one epoch it falls to 0 by half a cosine
  double weight_decay = 0.05;
  Augmentation augmentation{};
  std::uint64_t seed = 0;
};

struct Pretrained {
  Backbone backbone;
  std::vector<std::string> categories;
  Index training_pictures = 0, validation_pictures = 0;
  /// Share of the validation pictures whose category is recognised; NaN where there are none.
  double validation_accuracy = std::numeric_limits<double>::quiet_NaN();
};

/// A backbone trained from scratch to tell the categories of a dataset apart, with a dense layer on its pooled output
/// that is dropped in the end: softmax cross-entropy, Adam with decoupled weight decay. The same bits for any number of
/// threads. Throws Error for fewer than two categories, for a category with no object left to train on, for pictures
/// that cannot be read and where the loss is not finite.
Pretrained pretrain(const ViewDataset& dataset, const PretrainingOptions& options, const Messages& messages);

}  // namespace svnet
