#pragma once
#include <string>

#include "io/onnx/onnx_graph.h"
#include "models/sv_net.h"

namespace svnet::io {

/// Adds what makes the network's input `angles` of `poses`, (M, 2) theta and phi in degrees (models/sv_net.h): (M, A),
/// or (symmetries, M, A) for the azimuths of view/symmetry.h if there are several. Returns the name of the value.
std::string add_angles(OnnxGraph& to, const std::string& poses, models::AngleEncoding encoding, int symmetries);

}  // namespace svnet::io
