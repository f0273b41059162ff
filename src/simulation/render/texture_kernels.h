#pragma once
#include "simulation/render/rays.h"

namespace svnet::simulation {

/// surface_colour (simulation/texture.h) at many points of the object's own frame, with the same bits. The texture must
/// not be an image.
void paint(const Material&, std::size_t count, const Rows3& local_m, Rows3& colour);

}  // namespace svnet::simulation
