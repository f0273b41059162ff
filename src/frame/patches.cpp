#include "frame/patches.h"

#include <algorithm>
#include <array>
#include <utility>

namespace svnet::frame {
namespace {

constexpr std::array<std::pair<Index, Index>, 8> kSteps{
    {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

bool is_inside(Index row, Index column) {
  return row >= 0 && column >= 0 && row < kSide && column < kSide && in_circle(row, column);
}

}  // namespace

std::vector<Patch> patches_of(const Grid<std::uint8_t>& grid, std::uint8_t value, Neighbours neighbours) {
  const std::size_t steps = neighbours == Neighbours::four ? 4 : 8;
  Grid<std::uint8_t> seen(grid.size());
  std::vector<Patch> patches;
  for (Index start = 0; start < kCells; ++start) {
    const auto first = static_cast<std::size_t>(start);
    if (grid[first] != value || seen[first] != 0 || !in_circle(start / kSide, start % kSide)) continue;
    Patch patch;
    patch.cells.push_back(start);
    seen[first] = 1;
    for (std::size_t next = 0; next < patch.cells.size(); ++next) {
      const Index row = patch.cells[next] / kSide, column = patch.cells[next] % kSide;
      for (std::size_t i = 0; i < steps; ++i) {
        const Index y = row + kSteps[i].first, x = column + kSteps[i].second, cell = y * kSide + x;
        if (!is_inside(y, x)) {
          patch.touches_rim = true;
        } else if (const auto at = static_cast<std::size_t>(cell); grid[at] == value && seen[at] == 0) {
          seen[at] = 1;
          patch.cells.push_back(cell);
        }
      }
    }
    patch.area = static_cast<Index>(patch.cells.size());
    patches.push_back(std::move(patch));
  }
  std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.area > b.area; });
  return patches;
}

}  // namespace svnet::frame
