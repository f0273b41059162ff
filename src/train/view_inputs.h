#pragma once
#include <optional>
#include <vector>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "models/preprocessing.h"
#include "nn/runtime/inference.h"

namespace svnet::train {

/// The first input of a trained graph, for every view of a dataset in N orientations. Input view · N + orientation
/// belongs to that view and orientation.
class ViewInputs {
 public:
  virtual ~ViewInputs() = default;
  virtual int orientations() const { return 1; }
  /// The shape of one input.
  virtual Shape shape() const = 0;
  /// Returns the inputs with these indices, (inputs, shape…).
  virtual Tensor batch(std::span<const Index> inputs) const = 0;
};

/// Features that were computed before.
class FeatureInputs : public ViewInputs {
 public:
  /// Throws Error unless the rows of the features are the dataset's views. Keeps a reference to the features.
  FeatureInputs(const ViewDataset& dataset, const Features& features);
  Shape shape() const override { return {features_.dimension}; }
  Tensor batch(std::span<const Index> inputs) const override;

 private:
  const Features& features_;
};

/// The images of the views, or what the graph's frozen layers make of them. Images are read for each batch, except
/// those that keep() holds in memory. An input has the same bits in every batch.
class ImageInputs : public ViewInputs {
 public:
  struct Options {
    int orientations = 1;  ///< at most kSymmetries; if more than 1, images must be square
    bool flat = false;     ///< inputs are rows of floats, like features
  };
  /// `frozen` empty: the inputs are the pixels. Keeps a reference to the dataset. Throws Error if images must be square
  /// and are not.
  ImageInputs(const ViewDataset& dataset, const models::Preprocessing& preprocessing,
              std::shared_ptr<const Inference> frozen, const Options& options);
  int orientations() const override { return options_.orientations; }
  Shape shape() const override;
  Tensor batch(std::span<const Index> inputs) const override;

  /// Computes the inputs of these views in all orientations, and keeps them in memory. The processes of the
  /// communicator share the work.
  void keep(const std::vector<Index>& views, const Messages& messages, Communicator& communicator);

 private:
  Tensor compute(std::span<const Index> inputs) const;

  const ViewDataset& dataset_;
  models::Preprocessing preprocessing_;
  std::shared_ptr<const Inference> frozen_;
  Tensor kept_{};
  Options options_;
  std::vector<Index> kept_row_;  // of each input; -1: not kept
};

}  // namespace svnet::train
