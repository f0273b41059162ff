#include "frame/cleaned_mask.h"

#include <algorithm>

#include "frame/patches.h"

namespace svnet::frame {

Grid<std::uint8_t> cleaned_mask(const Grid<double>& difference, double likely, double sure) {
  constexpr Index kLeastSure = 3, kLeast = 8, kSpeck = 20, kHole = 10;
  Grid<std::uint8_t> candidates(difference.size());
  std::transform(difference.begin(), difference.end(), candidates.begin(),
                 [&](double value) { return static_cast<std::uint8_t>(value > likely); });
  Grid<std::uint8_t> mask(difference.size());
  Index largest = 0, area = 0;
  for (const Patch& patch : patches_of(candidates, 1, Neighbours::eight)) {
    if (patch.area < kLeast || kSpeck * patch.area < largest) break;  // the largest come first
    const Index sure_cells = std::count_if(patch.cells.begin(), patch.cells.end(), [&](Index cell) {
      return difference[static_cast<std::size_t>(cell)] > sure;
    });
    if (sure_cells < kLeastSure) continue;
    if (largest == 0) largest = patch.area;
    area += patch.area;
    for (const Index cell : patch.cells) mask[static_cast<std::size_t>(cell)] = 1;
  }
  for (const Patch& hole : patches_of(mask, 0, Neighbours::four))
    if (!hole.touches_rim && kHole * hole.area < area)
      for (const Index cell : hole.cells) mask[static_cast<std::size_t>(cell)] = 1;
  return mask;
}

}  // namespace svnet::frame
