#include "frame/otsu.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace svnet::frame {

double otsu_threshold(const Grid<double>& values) {
  constexpr double kMost = 0.95;
  constexpr std::size_t kBins = 256;
  std::vector<double> inside;
  inside.reserve(values.size());
  for (Index cell = 0; cell < kCells; ++cell)
    if (in_circle(cell / kSide, cell % kSide)) inside.push_back(values[static_cast<std::size_t>(cell)]);
  std::vector<double> ordered = inside;
  const auto place = ordered.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(ordered.size() - 1));
  std::nth_element(ordered.begin(), place, ordered.end());
  const double most = *place;
  if (!(most > 0)) return 0;

  std::array<Index, kBins> histogram{};
  Index total = 0;
  for (const double value : inside) {
    const auto bin = static_cast<std::size_t>(std::min(value / most, 1.0) * kBins);
    const std::size_t last = std::min(bin, kBins - 1);
    ++histogram[last];
    total += static_cast<Index>(last);
  }
  double best = -1;
  std::size_t best_bin = 0;
  Index below = 0, below_sum = 0;
  const auto count = static_cast<Index>(inside.size());
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    below += histogram[bin];
    below_sum += static_cast<Index>(bin) * histogram[bin];
    if (below == 0 || below == count) continue;
    const double n0 = static_cast<double>(below), n1 = static_cast<double>(count - below);
    const double step = static_cast<double>(below_sum) / n0 - static_cast<double>(total - below_sum) / n1;
    const double between = n0 * n1 * step * step;
    if (between > best) best = between, best_bin = bin;
  }
  return static_cast<double>(best_bin + 1) * most / kBins;
}

}  // namespace svnet::frame
