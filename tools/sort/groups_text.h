#pragma once
#include <string>
#include <vector>

#include "sort/grouping.h"
#include "sort/objects.h"

namespace svnet {

/// A line per group: its number from 1, a colon, and the names of its objects, separated by commas.
std::string groups_text(const Grouping& grouping, const std::vector<SortedObject>& objects);

/// How the groups were made.
struct GroupingChoices {
  bool estimated = true;  ///< the number of groups
  std::string backbone{}, weights_sha256{}, linkage{}, fusion{};
};

/// The document of --json: the choices, groups, objects with their group and pictures, and the dendrogram in SciPy's
/// form. Names that are not UTF-8 have replacement characters.
std::string groups_json(const Grouping& grouping, const std::vector<SortedObject>& objects,
                        const GroupingChoices& choices);

}  // namespace svnet
