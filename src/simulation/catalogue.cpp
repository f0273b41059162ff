#include "simulation/catalogue.h"

#include <algorithm>

#include "base/error.h"
#include "base/random.h"
#include "base/text.h"
#include "simulation/catalogue/designs.h"

namespace svnet::simulation {
namespace {

const std::vector<CategoryDesigns>& all_designs() {
  static const auto kAll = [] {
    std::vector<CategoryDesigns> all;
    for (const auto& some :
         {tool_designs(), cutlery_designs(), vessel_designs(), personal_designs(), household_designs()})
      all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(),
              [](const CategoryDesigns& a, const CategoryDesigns& b) { return std::string_view(a.name) < b.name; });
    return all;
  }();
  return kAll;
}

/// Sizes between those of two designs, each material from one of them.
Design mixture(const Design& a, const Design& b, RandomStream& random) {
  Design mixed = a;
  const auto share = static_cast<float>(random.uniform());
  for (std::size_t i = 0; i < a.number.size(); ++i) mixed.number[i] = a[i] + share * (b[i] - a[i]);
  for (std::size_t i = 0; i < std::min(a.look.size(), b.look.size()); ++i)
    if (random.below(2) == 1) mixed.look[i] = b.look[i];
  return mixed;
}

}  // namespace

const std::vector<std::string>& catalogue_names() {
  static const auto kNames = [] {
    std::vector<std::string> names;
    for (const CategoryDesigns& category : all_designs()) names.emplace_back(category.name);
    return names;
  }();
  return kNames;
}

Mesh catalogue_object(const std::string& category, Index object, std::uint64_t seed) {
  const auto& names = catalogue_names();
  const auto place = std::find(names.begin(), names.end(), category);
  check(place != names.end(), "there is no category '", category, "'", suggestion(category, names));
  const auto number = static_cast<std::size_t>(place - names.begin());
  const CategoryDesigns& chosen = all_designs()[number];
  Sculptor sculptor;
  if (object < kDesigns) {
    chosen.build(sculptor, chosen.designs[static_cast<std::size_t>(object)]);
  } else {
    RandomStream random(seed, Stream::collection,
                        std::uint64_t{0xffff0000u + number} << 32 | static_cast<std::uint64_t>(object));
    const std::uint32_t a = random.below(kDesigns), b = (a + 1 + random.below(kDesigns - 1)) % kDesigns;
    chosen.build(sculptor, mixture(chosen.designs[a], chosen.designs[b], random));
  }
  return sculptor.take();
}

}  // namespace svnet::simulation
