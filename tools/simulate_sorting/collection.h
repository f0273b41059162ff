#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"

namespace svnet {

/// Whether render_collection can be called: the program was built with the simulation.
bool can_render();

/// Renders a small collection of views into `folder`, which must not exist or be empty: 5 objects of each category in a
/// pose. `categories`: of the catalogue; empty: 6 that the seed draws, none of them in `left_out`. Throws Error if a
/// category is unknown.
void render_collection(const std::filesystem::path& folder, std::vector<std::string> categories,
                       const std::vector<std::string>& left_out, std::uint64_t seed, const Messages& messages);

}  // namespace svnet
