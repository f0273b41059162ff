#include "train/stages/held_out_results.h"

#include <algorithm>
#include <bit>

#include "io/models/model_file.h"

namespace svnet::train {
namespace {

HeldOutResults results_of(const Run& run, const EvaluationTable& table) {
  HeldOutResults results{.problems = static_cast<Index>(table.problems)};
  for (std::size_t c = 0; c < run.held_out.size(); ++c)
    if (run.held_out[c]) results.categories.push_back(run.dataset.categories[c]);
  for (std::size_t p = 0; p < table.pipelines.size(); ++p)
    for (std::size_t s = 0; s < table.selectors.size(); ++s)
      for (std::size_t m = 0; m < kMetrics.size(); ++m) {
        const Mean& cell = table.cells[p][s][m];
        results.values.push_back(
            {table.pipelines[p], table.selectors[s], kMetrics[m].name, cell.mean, cell.standard_error});
      }
  return results;
}

/// Whether both hold the same numbers; NaN equals NaN.
bool same(const HeldOutResults& a, const HeldOutResults& b) {
  const auto same_value = [](const HeldOutResults::Value& x, const HeldOutResults::Value& y) {
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    return x.pipeline == y.pipeline && x.selector == y.selector && x.metric == y.metric &&
           bits(x.mean) == bits(y.mean) && bits(x.standard_error) == bits(y.standard_error);
  };
  const auto by_name = [](HeldOutResults results) {  // files list values by name
    std::ranges::sort(results.values, {}, [](const HeldOutResults::Value& value) {
      return std::tuple(value.pipeline, value.selector, value.metric);
    });
    return results;
  };
  const HeldOutResults first = by_name(a), second = by_name(b);
  return a.categories == b.categories && a.problems == b.problems &&
         std::ranges::equal(first.values, second.values, same_value);
}

}  // namespace

void keep_held_out_results(const Run& run, Model model, const EvaluationTable& held_out) {
  HeldOutResults results = results_of(run, held_out);
  if (same(model.held_out, results)) return;
  model.held_out = std::move(results);
  io::write_model(run.folder / "model.safetensors", model);
}

}  // namespace svnet::train
