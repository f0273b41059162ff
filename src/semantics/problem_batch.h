#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "semantics/aligned_array.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"
#include "semantics/view_sets.h"

namespace svnet::semantics {

/// Many problems, each with the distances between its items. The distances of one problem are scattered over the whole
/// matrix: to fetch them problem by problem costs a cache miss each. Here the items of all problems are sorted by
/// matrix row. Each row is read once, for all problems that need it, while it is in the cache.
///
/// The items of a problem are sorted by category, object and pose; the order of drawing does not matter. An item is a
/// view, or a set of views: then the distances are those between all views of the items, set by set.
class ProblemBatch {
 public:
  static constexpr std::uint64_t kMaxProblems = 16384;

  /// Keeps references to all arguments. With `sets`, the problems' views are numbers of sets. Requires: `parallel`
  /// keeps its number of threads.
  ProblemBatch(const DistanceMatrix& distances, const ClusteringProblems& problems, Parallel& parallel,
               const ViewSets* sets = nullptr);

  /// Draws up to `wanted` problems from problem `first` on, fewer if memory is full. Returns their number, at least 1.
  std::uint64_t draw(std::uint64_t seed, std::uint64_t first, std::uint64_t wanted);

  // Items, distances and number of categories of problem p of the last draw.
  std::span<const std::int32_t> items(Index p) const {
    return sets_ == nullptr ? rows(p) : std::span(&drawn_sets_[p * max_items_], item_count_[p]);
  }
  LowerTriangle distances(Index p) const { return {triangles_.data() + offset_[p], row_count(p)}; }
  Index categories(Index p) const { return category_count_[p]; }

 private:
  /// A view of a problem: row number `position` of its triangle.
  struct Row {
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
  void sort_rows();
  void copy_rows(Index begin, Index end);
  Index row_count(Index p) const { return item_count_[p] * views_per_item_; }
  /// The rows of the matrix that problem p has.
  std::span<const std::int32_t> rows(Index p) const { return std::span(&rows_[p * max_rows_], row_count(p)); }

  const DistanceMatrix& matrix_;
  const ClusteringProblems& problems_;
  Parallel& parallel_;
  const ViewSets* sets_;
  Index views_per_item_, max_items_, max_rows_, capacity_, drawn_ = 0;
  std::vector<Drawer> drawers_;
  std::vector<std::int32_t> item_count_, category_count_;  // (capacity)
  std::vector<Index> offset_;                              // (capacity + 1) offsets of the triangles
  AlignedArray<std::int32_t> drawn_sets_;                  // (capacity, max_items), only of sets
  AlignedArray<std::int32_t> rows_;                        // (capacity, max_rows)
  std::vector<std::uint32_t> next_;   // (chunks, matrix rows) index in sorted_ of a chunk's next entry of a row
  std::vector<std::uint32_t> first_;  // (matrix rows + 1) index in sorted_ of the first entry of a row
  AlignedArray<Row> sorted_;          // (capacity * max_rows) sorted by row of the matrix
  Index triangle_room_;               // floats of triangles_
  AlignedArray<float> triangles_;
};

}  // namespace svnet::semantics
