#pragma once
#include "base/progress.h"
#include "data/view_dataset.h"
#include "train/feature_extraction.h"

namespace svnet::train {

/// Pictures that calibrate a backbone for products in int8, unless the user says otherwise.
inline constexpr Index kCalibrationImages = 64;

/// The backbone with products in int8, for activations as `images` views of the dataset give them: view
/// ⌊i · views / images⌋ for each i, all views if there are no more. Runs them in f32. The same views give the same bits
/// for any number of threads and processes. Throws Error if the dataset is empty or an activation is not finite.
BackboneWithOrigin calibrated(const BackboneWithOrigin& from, const ViewDataset& dataset, Index images,
                              const Messages& messages);

}  // namespace svnet::train
