#pragma once
#include <vector>

#include "image/image.h"
#include "simulate_sorting/simulation_text.h"

namespace svnet {

/// The first table: its objects from above in their order, and below, side by side, the bins that these selectors
/// (indices) filled, each object in the views that the selector chose. An object has a frame in the colour of its
/// category; a wrong one has a cross. Throws Error that names an image that cannot be read.
Image table_picture(const SimulationReport& report, const std::vector<std::size_t>& selectors);

}  // namespace svnet
