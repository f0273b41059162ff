#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "semantics/aligned_array.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"

namespace svnet {

/// Many problems at once, with the distances between the items of each. One problem's distances are scattered over the
/// whole matrix, and fetching them alone costs a cache miss each. Here the items of all problems are sorted by matrix
/// row, and every row is read once, while it is in the cache, for all problems that need it.
///
/// Items of a problem stand in ascending order of category, object and pose, whatever the order of drawing.
class ProblemBatch {
 public:
  static constexpr std::uint64_t kMaxProblems = 16384;

  /// Keeps references to all; `parallel` must keep its number of threads.
  ProblemBatch(const DistanceMatrix& distances, const ClusteringProblems& problems, Parallel& parallel);

  /// Draws problems from `first` on, `wanted` or as many as there is room for, at least one, and returns their number.
  std::uint64_t draw(std::uint64_t seed, std::uint64_t first, std::uint64_t wanted);

  /// Problem p of those drawn last.
  std::span<const std::int32_t> rows(Index p) const { return std::span(&rows_[p * max_items_], item_count_[p]); }
  LowerTriangle distances(Index p) const { return {triangles_.data() + offset_[p], item_count_[p]}; }
  Index categories(Index p) const { return category_count_[p]; }

 private:
  /// An item of a problem, listed with its matrix row.
  struct Item {
    std::uint32_t problem, position;
  };
  /// What one thread draws with.
  struct Drawer {
    ClusteringProblem problem;
    std::vector<std::uint64_t> places, occupied;  // bit sets: of the problem's views by place, of the words in use
  };
  void draw_chunk(std::uint64_t seed, std::uint64_t first, Index begin, Index end, Drawer& drawer);
  void keep_what_fits();
  void sort_items();
  void serve_rows(Index begin, Index end);

  const DistanceMatrix& matrix_;
  const ClusteringProblems& problems_;
  Parallel& parallel_;
  Index max_items_, capacity_, drawn_ = 0;
  std::vector<Drawer> drawers_;
  std::vector<std::int32_t> item_count_, category_count_;  // (capacity)
  std::vector<Index> offset_;                              // (capacity + 1) of the triangles
  AlignedArray<std::int32_t> rows_;                        // (capacity, max_items)
  std::vector<std::uint32_t> next_item_;                   // (chunks, views) where a chunk's next item of a row goes
  std::vector<std::uint32_t> first_item_;                  // (views + 1) of each row
  AlignedArray<Item> items_;                               // (capacity * max_items) sorted by row
  Index triangle_room_;                                    // floats
  AlignedArray<float> triangles_;
};

}  // namespace svnet
