#include "sorting/summary.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/quantile.h"
#include "base/random.h"

namespace svnet::sorting {
namespace {

constexpr std::size_t kReplicates = 2000;

}  // namespace

train::Interval interval_of_mean(std::span<const double> values, std::uint64_t seed) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (values.size() < 2) return {kUnknown, kUnknown};
  std::vector<double> means;
  for (std::size_t replicate = 0; replicate < kReplicates; ++replicate) {
    RandomStream random(seed, Stream::bootstrap, replicate);
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += values[random.below(static_cast<std::uint32_t>(values.size()))];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::ranges::sort(means);
  return {quantile(means, 0.025), quantile(means, 0.975)};
}

std::vector<SelectorSummary> summaries(std::span<const SortedTable> tables, std::uint64_t seed) {
  check(!tables.empty(), "[simulation] there are no tables");
  const auto count = static_cast<double>(tables.size());
  std::vector<SelectorSummary> all;
  for (std::size_t s = 0; s < tables[0].outcomes.size(); ++s) {
    SelectorSummary summary;
    std::vector<double> fewer;
    for (const SortedTable& table : tables) {
      const Outcome& outcome = table.outcomes[s];
      summary.wrong += static_cast<double>(outcome.wrong_count) / count;
      summary.moves += static_cast<double>(outcome.camera.moves) / count;
      summary.seconds += outcome.camera.seconds / count;
      fewer.push_back(static_cast<double>(table.outcomes[0].wrong_count - outcome.wrong_count));
    }
    for (const double value : fewer) summary.fewer_than_first += value / count;
    summary.interval = interval_of_mean(fewer, seed);
    all.push_back(summary);
  }
  return all;
}

}  // namespace svnet::sorting
