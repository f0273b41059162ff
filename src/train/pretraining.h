#pragma once
#include <limits>
#include <string>
#include <vector>

#include "base/progress.h"
#include "data/view_dataset.h"
#include "models/backbone.h"
#include "train/augmentation.h"

namespace svnet::train {

struct PretrainingOptions {
  std::string backbone = "tiny_xception";
  std::vector<std::string> exclude;  ///< categories that take no part
  Index validation_objects = 1;      ///< the last N objects of each category are not trained on
  Index epochs = 30;
  Index batch_size = 32;
  double learning_rate = 2e-3;  ///< the highest: it warms up in at most one epoch, then falls to 0 by half a cosine
  double weight_decay = 0.05;
  Augmentation augmentation{};
  std::uint64_t seed = 0;
  InferenceOptions inference{};
};

struct Pretrained {
  models::Backbone backbone;
  std::vector<std::string> categories;
  Index training_images = 0, validation_images = 0;
  /// Share of the validation images whose category is recognised; NaN if there are none.
  double validation_accuracy = std::numeric_limits<double>::quiet_NaN();
};

/// Trains a backbone from scratch to classify the categories of a dataset, and returns it. A dense layer on its pooled
/// output is trained with it and then dropped. Softmax cross-entropy, Adam with decoupled weight decay. The bits do not
/// depend on the number of threads. Throws Error if there are fewer than 2 categories, if a category has no object left
/// to train on, if an image cannot be read, or if the loss is not finite.
Pretrained pretrain(const ViewDataset& dataset, const PretrainingOptions& options, const Messages& messages);

}  // namespace svnet::train
