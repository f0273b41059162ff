#include "train/dataset_rows.h"

#include <algorithm>
#include <map>

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

void name_rows(const ViewDataset& dataset, Features& features, const std::string& what) {
  if (!features.paths.empty()) return;
  check(features.labels.size() == dataset.views.size(), what, ": has ", features.labels.size(),
        " rows and no paths, the data set has ", dataset.views.size(), " views");
  std::map<std::int64_t, Index> category_of;
  std::map<Index, std::int64_t> label_of;
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    const auto& [theta_deg, phi_deg] = features.theta_phi_deg[i];
    check(theta_deg == view.theta_deg && phi_deg == view.phi_deg, what, ": row ", i, " has the angles ", theta_deg,
          ", ", phi_deg, ", the view there is ", view.path,
          "; rows without paths must be in the order of the data set, by category, object, pose and name");
    const std::int64_t label = features.labels[i];
    const bool fits = category_of.emplace(label, view.category).first->second == view.category &&
                      label_of.emplace(view.category, label).first->second == label;
    check(fits, what, ": row ", i, " has the label ", label, ", which does not fit the category of ", view.path,
          "; rows without paths must be in the order of the data set");
    features.paths.push_back(view.path);
  }
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
