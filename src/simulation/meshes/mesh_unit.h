#pragma once
#include <functional>
#include <optional>
#include <string>

namespace svnet::simulation {

/// Metres per unit of a mesh that is `length` units long. Files do not say their unit: `given` decides; without it
/// metres if the object can be collected then, else centimetres or millimetres if only one of them makes a
/// household object of it, in a line to `warn`. Throws Error, which begins with `name`, if the object is too large
/// or too small to be collected, or both units make sense.
double metres_per_unit(double length, const std::string& name, std::optional<double> given,
                       const std::function<void(const std::string& line)>& warn);

}  // namespace svnet::simulation
