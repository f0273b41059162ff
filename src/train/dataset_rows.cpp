#include "train/dataset_rows.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/views/composed_name.h"

namespace svnet::train {

void check_rows(const ViewDataset& dataset, const std::vector<std::string>& paths, const std::string& what) {
  check(paths.size() == dataset.views.size(), what, " of ", paths.size(), " views do not belong to a dataset of ",
        dataset.views.size());
  for (std::size_t i = 0; i < paths.size(); ++i)
    check(io::composed_name(paths[i]) == io::composed_name(dataset.views[i].path), what, ": row ", i, " is ", paths[i],
          ", the dataset has ", dataset.views[i].path);
}

std::vector<bool> named_categories(const ViewDataset& dataset, const std::vector<std::string>& names,
                                   const std::string& key) {
  std::vector<bool> named(dataset.categories.size(), false);
  for (const auto& name : names) {
    const auto at = std::find(dataset.categories.begin(), dataset.categories.end(), io::composed_name(name));
    check(at != dataset.categories.end(), key, ": the dataset has no category '", name, "'",
          suggestion(name, dataset.categories));
    named[static_cast<std::size_t>(at - dataset.categories.begin())] = true;
  }
  return named;
}

}  // namespace svnet::train
