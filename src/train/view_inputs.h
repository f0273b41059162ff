#pragma once
#include <optional>
#include <vector>

#include "base/progress.h"
#include "base/team.h"
#include "io/features_file.h"
#include "io/view_dataset.h"
#include "models/image/preprocessing.h"
#include "nn/runtime/inference.h"

namespace svnet {

/// What a trained graph sees of the views of a dataset, by their numbers: its first input.
class ViewInputs {
 public:
  virtual ~ViewInputs() = default;
  /// Of one view.
  virtual Shape shape() const = 0;
  /// (views, shape...).
  virtual Tensor batch(std::span<const Index> views) const = 0;
};

/// Features that were extracted before.
class FeatureInputs : public ViewInputs {
 public:
  /// Rows of the features are the dataset's views (Error where they are not). Keeps a reference to the features.
  FeatureInputs(const ViewDataset& dataset, const Features& features);
  Shape shape() const override { return {features_.dimension}; }
  Tensor batch(std::span<const Index> views) const override;

 private:
  const Features& features_;
};

/// Pictures, read whenever they are asked for, and what frozen layers make of them. A view's numbers do not depend on
/// the views that are asked for with it.
class PictureInputs : public ViewInputs {
 public:
  /// Without frozen layers the input are the pixels. Keeps a reference to the dataset.
  PictureInputs(const ViewDataset& dataset, const Preprocessing& preprocessing,
                std::shared_ptr<const Inference> frozen);
  Shape shape() const override;
  Tensor batch(std::span<const Index> views) const override;

  /// Computes the inputs of these views once and for all, and keeps them in memory; a team shares the work.
  void keep(const std::vector<Index>& views, const Messages& messages, Team& team);

 private:
  Tensor made(std::span<const Index> views) const;

  const ViewDataset& dataset_;
  Preprocessing preprocessing_;
  std::shared_ptr<const Inference> frozen_;
  Tensor kept_{};
  std::vector<Index> kept_row_;  // of each view, -1 where it is not kept
};

}  // namespace svnet
