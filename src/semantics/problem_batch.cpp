#include "semantics/problem_batch.h"

#include <algorithm>
#include <bit>

namespace svnet::semantics {
namespace {

constexpr Index kChunk = 512;                 // problems that are drawn and sorted as one chunk
constexpr Index kRowChunk = 16;               // matrix rows that are copied as one chunk
constexpr Index kMaxRows = Index{1} << 22;    // views of all problems
constexpr Index kMaxFloats = Index{1} << 25;  // floats of all triangles; one problem may need more
constexpr Index kAhead = 8;                   // prefetch distance in views
constexpr Index kLine = LowerTriangle::kLine;

Index capacity_for(Index max_rows) { return std::clamp<Index>(kMaxRows / max_rows, 1, ProblemBatch::kMaxProblems); }

Index chunks_of(Index problems) { return (problems + kChunk - 1) / kChunk; }

}  // namespace

ProblemBatch::ProblemBatch(const DistanceMatrix& distances, const ClusteringProblems& problems, Parallel& parallel,
                           const ViewSets* sets)
    : matrix_(distances),
      problems_(problems),
      parallel_(parallel),
      sets_(sets),
      views_per_item_(sets == nullptr ? 1 : sets->size),
      max_items_(problems.max_items()),
      max_rows_(max_items_ * views_per_item_),
      capacity_(capacity_for(max_rows_)),
      item_count_(capacity_),
      category_count_(capacity_),
      offset_(capacity_ + 1),
      drawn_sets_(sets == nullptr ? 0 : capacity_ * max_items_, AlignedArray<std::int32_t>::Contents::undefined),
      rows_(capacity_ * max_rows_, AlignedArray<std::int32_t>::Contents::undefined),
      next_(chunks_of(capacity_) * distances.size()),
      first_(distances.size() + 1),
      sorted_(capacity_ * max_rows_, AlignedArray<Row>::Contents::undefined),
      triangle_room_(
          std::max(LowerTriangle::size(max_rows_), std::min(kMaxFloats, capacity_ * LowerTriangle::size(max_rows_)))),
      triangles_(triangle_room_, AlignedArray<float>::Contents::undefined) {
  const std::size_t words = (problems.views() + 63) / 64;
  for (int i = 0; i < parallel.threads(); ++i)
    drawers_.push_back(
        {problems.new_problem(), std::vector<std::uint64_t>(words), std::vector<std::uint64_t>((words + 63) / 64)});
}

std::uint64_t ProblemBatch::draw(std::uint64_t seed, std::uint64_t first, std::uint64_t wanted) {
  drawn_ = std::min<std::uint64_t>(wanted, capacity_);
  parallel_.for_chunks(drawn_, kChunk, [&](Index begin, Index end, int worker) {
    draw_chunk(seed, first, begin, end, drawers_[worker]);
  });
  drop_what_does_not_fit();
  sort_rows();
  parallel_.for_chunks(matrix_.size(), kRowChunk, [&](Index begin, Index end, int) { copy_rows(begin, end); });
  return drawn_;
}

void ProblemBatch::draw_chunk(std::uint64_t seed, std::uint64_t first, Index begin, Index end, Drawer& drawer) {
  for (Index p = begin; p < end; ++p) {
    auto& problem = drawer.problem;
    problems_.draw(seed, first + p, problem);
    item_count_[p] = problem.rows.size();
    category_count_[p] = problem.categories;
    for (const std::int32_t row : problem.rows) {
      const std::uint32_t place = problems_.place_of_view(row);
      drawer.places[place / 64] |= std::uint64_t{1} << place % 64;
      drawer.occupied[place / 4096] |= std::uint64_t{1} << place / 64 % 64;
    }
    std::int32_t* sorted = sets_ == nullptr ? rows_.data() + p * max_rows_ : drawn_sets_.data() + p * max_items_;
    for (std::size_t block = 0; block < drawer.occupied.size(); ++block) {
      for (std::uint64_t words = drawer.occupied[block]; words != 0; words &= words - 1) {
        const std::size_t word = 64 * block + std::countr_zero(words);
        for (std::uint64_t bits = drawer.places[word]; bits != 0; bits &= bits - 1)
          *sorted++ = problems_.view_at(64 * word + std::countr_zero(bits));
        drawer.places[word] = 0;
      }
      drawer.occupied[block] = 0;
    }
    if (sets_ == nullptr) continue;
    std::int32_t* to = rows_.data() + p * max_rows_;
    for (const std::int32_t set : items(p)) to = std::ranges::copy(sets_->set(set), to).out;
  }
}

void ProblemBatch::drop_what_does_not_fit() {
  offset_[0] = 0;
  for (Index p = 0; p < drawn_; ++p) {
    offset_[p + 1] = offset_[p] + LowerTriangle::size(row_count(p));
    if (offset_[p + 1] > triangle_room_) drawn_ = p;  // p > 0: the largest problem fits
  }
}

/// Counting sort: every chunk counts its views per row of the matrix, then writes them to its own range of sorted_.
void ProblemBatch::sort_rows() {
  const Index views = matrix_.size(), chunks = chunks_of(drawn_);
  const auto of_chunk = [&](Index begin) { return next_.data() + begin / kChunk * views; };
  parallel_.for_chunks(drawn_, kChunk, [&](Index begin, Index end, int) {
    std::uint32_t* count = of_chunk(begin);
    std::fill_n(count, views, 0);
    for (Index p = begin; p < end; ++p)
      for (const std::int32_t row : rows(p)) ++count[row];
  });
  std::uint32_t next = 0;
  for (Index row = 0; row < views; ++row) {
    first_[row] = next;
    for (Index chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t& entry = next_[chunk * views + row];
      const std::uint32_t count = entry;
      entry = next;
      next += count;
    }
  }
  first_[views] = next;
  parallel_.for_chunks(drawn_, kChunk, [&](Index begin, Index end, int) {
    std::uint32_t* place = of_chunk(begin);
    for (Index p = begin; p < end; ++p) {
      std::uint32_t position = 0;
      for (const std::int32_t row : rows(p)) sorted_[place[row]++] = {static_cast<std::uint32_t>(p), position++};
    }
  });
}

/// Copies the distances of matrix rows [begin, end) to the triangles of all problems that need them.
void ProblemBatch::copy_rows(Index begin, Index end) {
  const std::uint32_t last = first_[end];
  for (Index row = begin; row < end; ++row) {
    const float* from = matrix_.row(row);
    // The next row is prefetched while this one is copied: an equal part of it per entry.
    const Index count = first_[row + 1] - first_[row];
    const float* next_row = row + 1 < end ? matrix_.row(row + 1) : from;
    const Index next_lines = row + 1 < end ? (row + 1 + kLine) / kLine : 0;
    const Index lines_per_entry = count == 0 ? 0 : (next_lines + count - 1) / count;
    Index line = 0;
    for (std::uint32_t i = first_[row]; i < first_[row + 1]; ++i) {
      if (i + kAhead < last) {
        const Row ahead = sorted_[i + kAhead];
        const std::int32_t* list = rows_.data() + ahead.problem * max_rows_;
        const float* to = triangles_.data() + offset_[ahead.problem] + LowerTriangle::row_offset(ahead.position);
        for (Index j = 0; j < ahead.position; j += kLine) {
          __builtin_prefetch(list + j);
          __builtin_prefetch(to + j, 1);
        }
      }
      for (Index n = 0; n < lines_per_entry && line < next_lines; ++n, ++line)
        __builtin_prefetch(next_row + line * kLine);
      const Row entry = sorted_[i];
      const std::int32_t* list = rows_.data() + entry.problem * max_rows_;
      float* to = triangles_.data() + offset_[entry.problem] + LowerTriangle::row_offset(entry.position);
      std::uint32_t j = 0;
      for (; j + 4 <= entry.position; j += 4) {
        const float a = from[list[j]], b = from[list[j + 1]], c = from[list[j + 2]], d = from[list[j + 3]];
        to[j] = a, to[j + 1] = b, to[j + 2] = c, to[j + 3] = d;
      }
      for (; j < entry.position; ++j) to[j] = from[list[j]];
    }
  }
}

}  // namespace svnet::semantics
