#include <algorithm>

#include "base/random.h"
#include "simulate_sorting/collection.h"
#include "simulation/rendered_dataset.h"

namespace svnet {
namespace {

constexpr std::size_t kCategories = 6;
constexpr Index kObjects = 5, kPoses = 1, kSize_px = 96;

}  // namespace

bool can_render() { return true; }

void render_collection(const std::filesystem::path& folder, std::vector<std::string> categories,
                       const std::vector<std::string>& left_out, std::uint64_t seed, const Messages& messages) {
  if (categories.empty()) {
    for (const std::string& name : simulation::catalogue_names())
      if (std::ranges::find(left_out, name) == left_out.end()) categories.push_back(name);
    RandomStream random(seed, Stream::collection);
    const std::size_t count = std::min(kCategories, categories.size());
    draw_without_replacement(random, categories.data(), std::ssize(categories), static_cast<Index>(count));
    categories.resize(count);
  }
  simulation::render_dataset({.output = folder,
                              .meshes = {},
                              .categories = std::move(categories),
                              .objects = kObjects,
                              .poses = kPoses,
                              .size = kSize_px,
                              .seed = seed},
                             messages);
}

}  // namespace svnet
