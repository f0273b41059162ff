#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "semantics/aligned_array.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"

namespace svnet::semantics {

/// Many problems, each with the distances between its items. The distances of one problem are scattered over the whole
/// matrix: to fetch them problem by problem costs a cache miss each. Here the items of all problems are sorted by
/// matrix row. Each row is read once, for all problems that need it, while it is in the cache.
///
/// The items of a problem are sorted by category, object and pose; the order of drawing does not matter.
class ProblemBatch {
 public:
  static constexpr std::uint64_t kMaxProblems = 16384;

  /// Keeps references to all arguments. Requires: `parallel` keeps its number of threads.
  ProblemBatch(const DistanceMatrix& distances, const ClusteringProblems& problems, Parallel& parallel);

  /// Draws up to `wanted` problems from problem `first` on, fewer if memory is full. Returns their number, at least 1.
  std::uint64_t draw(std::uint64_t seed, std::uint64_t first, std::uint64_t wanted);

  // Views, distances and number of categories of problem p of the last draw.
  std::span<const std::int32_t> rows(Index p) const { return std::span(&rows_[p * max_items_], item_count_[p]); }
  LowerTriangle distances(Index p) const { return {triangles_.data() + offset_[p], item_count_[p]}; }
  Index categories(Index p) const { return category_count_[p]; }

 private:
  /// An item of a problem: row number `position` of its triangle.
  struct Item {
    std::uint32_t problem, position;
  };
  /// The memory in which one thread draws.
  struct Drawer {
    ClusteringProblem problem;
    std::vector<std::uint64_t> places,
        occupied;  // bit sets: places of the problem's views; words of `places` that are not 0
  };
  void draw_chunk(std::uint64_t seed, std::uint64_t first, Index begin, Index end, Drawer& drawer);
  void drop_what_does_not_fit();
  void sort_items();
  void copy_rows(Index begin, Index end);

  const DistanceMatrix& matrix_;
  const ClusteringProblems& problems_;
  Parallel& parallel_;
  Index max_items_, capacity_, drawn_ = 0;
  std::vector<Drawer> drawers_;
  std::vector<std::int32_t> item_count_, category_count_;  // (capacity)
  std::vector<Index> offset_;                              // (capacity + 1) offsets of the triangles
  AlignedArray<std::int32_t> rows_;                        // (capacity, max_items)
  std::vector<std::uint32_t> next_item_;   // (chunks, views) index in items_ of a chunk's next item of a row
  std::vector<std::uint32_t> first_item_;  // (views + 1) index in items_ of the first item of a row
  AlignedArray<Item> items_;               // (capacity * max_items) sorted by row
  Index triangle_room_;                    // floats of triangles_
  AlignedArray<float> triangles_;
};

}  // namespace svnet::semantics
