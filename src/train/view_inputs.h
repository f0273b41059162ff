#pragma once
#include <optional>
#include <vector>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "models/preprocessing.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// What a trained graph sees of the views of a dataset, each in so many orientations: its first input. Input number
/// view · orientations + orientation.
class ViewInputs {
 public:
  virtual ~ViewInputs() = default;
  virtual int orientations() const { return 1; }
  /// Of one view.
  virtual Shape shape() const = 0;
  /// (inputs, shape...).
  virtual Tensor batch(std::span<const Index> inputs) const = 0;
};

/// Features that were extracted before.
class FeatureInputs : public ViewInputs {
 public:
  /// Rows of the features are the dataset's views (Error where they are not). Keeps a reference to the features.
  FeatureInputs(const ViewDataset& dataset, const Features& features);
  Shape shape() const override { return {features_.dimension}; }
  Tensor batch(std::span<const Index> inputs) const override;

 private:
  const Features& features_;
};

/// Pictures, read whenever they are asked for, and what frozen layers make of them. What an input is does not depend on
/// the inputs that are asked for with it.
class PictureInputs : public ViewInputs {
 public:
  struct Options {
    int orientations = 1;  ///< at most kSymmetries; with more than one the network's pictures must be square
    bool flat = false;     ///< rows of numbers, as features are
  };
  /// Without frozen layers the input are the pixels. Keeps a reference to the dataset. Throws Error where pictures must
  /// be square and are not.
  PictureInputs(const ViewDataset& dataset, const Preprocessing& preprocessing, std::shared_ptr<const Inference> frozen,
                const Options& options);
  int orientations() const override { return options_.orientations; }
  Shape shape() const override;
  Tensor batch(std::span<const Index> inputs) const override;

  /// Computes these views in all orientations once and for all, and keeps them in memory; a communicator shares the
  /// work.
  void keep(const std::vector<Index>& views, const Messages& messages, Communicator& communicator);

 private:
  Tensor made(std::span<const Index> inputs) const;

  const ViewDataset& dataset_;
  Preprocessing preprocessing_;
  std::shared_ptr<const Inference> frozen_;
  Tensor kept_{};
  Options options_;
  std::vector<Index> kept_row_;  // of each input, -1 where it is not kept
};

}  // namespace svnet
