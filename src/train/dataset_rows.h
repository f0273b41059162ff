#pragma once
#include <string>
#include <vector>

#include "data/features.h"
#include "data/view_dataset.h"

namespace svnet::train {

/// Throws Error, beginning with `what`, unless `paths` are the dataset's views in its order.
void check_rows(const ViewDataset& dataset, const std::vector<std::string>& paths, const std::string& what);

/// Names the rows of features that have labels instead of paths (io/views/features_file.h): they are the dataset's
/// views in its order. Throws Error, beginning with `what`, unless there are as many rows as views, the angles are
/// those of the views, and equal labels mean equal categories. Features with paths stay as they are.
void name_rows(const ViewDataset& dataset, Features& features, const std::string& what);

/// For each category of the dataset, whether it is in `names`. Throws Error, beginning with `key` and with the nearest
/// category, if a name is no category.
std::vector<bool> named_categories(const ViewDataset& dataset, const std::vector<std::string>& names,
                                   const std::string& key);

}  // namespace svnet::train
