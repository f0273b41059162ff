#pragma once
#include <string>
#include <vector>

#include "data/view_dataset.h"

namespace svnet::train {

/// Throws Error, beginning with `what`, unless `paths` are the dataset's views in its order.
void check_rows(const ViewDataset& dataset, const std::vector<std::string>& paths, const std::string& what);

/// For each category of the dataset, whether it is in `names`. Throws Error, beginning with `key` and with the nearest
/// category, if a name is no category.
std::vector<bool> named_categories(const ViewDataset& dataset, const std::vector<std::string>& names,
                                   const std::string& key);

}  // namespace svnet::train
