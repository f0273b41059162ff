#pragma once
#include "view/half_sphere_canvas.h"

namespace svnet::view {

/// The colour of a height in [0, 1]: from dark blue through green to yellow. Brightness rises with the height, so that
/// a grey print keeps the order. Heights outside the range have the colour of the nearer end.
Colour scale_colour(double height);

}  // namespace svnet::view
