#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "sorting/camera_work.h"
#include "sorting/table.h"
#include "train/selectors.h"

namespace svnet::sorting {

/// How many groups the objects of a table are put into.
struct GroupRule {
  enum class Kind { categories, estimated, fixed };
  Kind kind = Kind::categories;  ///< as many as the table has categories; estimated (semantics/group_count.h); `count`
  Index count = 0;
};

struct SimulationOptions {
  Index tables = 200;
  Index objects = 12;  ///< on a table
  GroupRule groups{};
  std::uint64_t seed = 0;
  MoveTime time{};
};

/// A table as it was sorted with the views of one selector.
struct Outcome {
  std::vector<std::int32_t> views;  ///< (objects, views of the selector) of the dataset
  std::vector<std::int32_t> bins;   ///< (objects) numbered from 0 in order of first appearance
  std::vector<bool> wrong;          ///< (objects) as in_wrong_bin says
  Index wrong_count = 0;
  CameraWork camera{};
};

struct SortedTable {
  Table table;
  std::vector<Outcome> outcomes;  ///< of each selector
};

/// Sorts random tables with each selector. An object is seen in the views that the selector chooses for its pose; the
/// mean of their features is that of the object. The objects of a table are grouped by Ward's method, and each group
/// goes into a bin. Random views are of Stream::selector. `features`: (views, dimension) of the dataset. The same bits
/// for any number of threads. Throws Error as Tables does, and for more groups than objects.
std::vector<SortedTable> simulate(const ViewDataset& dataset, std::span<const float> features,
                                  std::span<const train::Selector> selectors, const SimulationOptions& options,
                                  const Messages& messages, Parallel& parallel);

}  // namespace svnet::sorting
