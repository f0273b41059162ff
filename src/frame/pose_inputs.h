#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/enum_names.h"
#include "frame/heights.h"
#include "frame/object_axis.h"
#include "view/camera_pose.h"

// The inputs of a head for a camera pose (θ, φ), measured in the object's own frame. With
//   x = (φ - 65) / 15, in degrees           α = θ - the axis' direction
//   c = cos φ, and 0 if φ >= 89.5           e, s, f: the axis' elongation, skew, fill
//   E = 2 (e - .5)   S = 10 s - .5   F = G = ln f + 2.5   T = height - .25   W = min(height / width, 2) - .5
// the inputs are, in this order:
//   phi      x, x² - 1, [φ >= 89.5], [φ < 10]
//   axis     a1 = 10 s c cos α, a2 = 2 (1 - e) c cos 2α, a4 = 2 (1 - e) c cos 4α; a1 x, a2 x, a4 x;
//            all 0 unless the axis is found; m = 1 unless it is found, else 0; m x
//   shape    E x, S x, F x, 0 if the axis is unclear; each of a1, a2, a4 times each of E, S, F
//   heights  T, W, G; T x, W x, G x; each of a1, a2, a4 times each of T, W; all 0 unless the heights are known;
//            h = 1 unless they are known, else 0; h x
// A head in a frame with turns has more inputs, of the group turned (frame_inputs.h).
// E, S, F, T, W and G are about 0 for a common object, and of size 1. Inputs that do not depend on the pose matter only
// to heads that compare objects.
namespace svnet::frame {

/// Inputs of one group share a penalty in a head: phi, axis and relation a small one, the others a larger one. relation
/// and second are groups of next_inputs.h.
enum class InputGroup { phi, axis, shape, heights, turned, relation, second };

/// Whether inputs of the group say how scores depend on the shape of the object, not what holds for every object.
constexpr bool is_of_shape(InputGroup group) {
  return group != InputGroup::phi && group != InputGroup::axis && group != InputGroup::relation;
}

struct PoseInputOptions {
  bool axis = true;      ///< the group axis
  bool shape = false;    ///< the group shape
  bool heights = false;  ///< the group heights
};

constexpr auto enum_table(InputGroup) {
  return std::to_array<EnumName<InputGroup>>({{InputGroup::phi, "phi"},
                                              {InputGroup::axis, "axis"},
                                              {InputGroup::shape, "shape"},
                                              {InputGroup::heights, "heights"},
                                              {InputGroup::turned, "turned"},
                                              {InputGroup::relation, "relation"},
                                              {InputGroup::second, "second"}});
}

/// E, S, F, T and W above: the shape of an object, whatever the camera pose. E, S and F are NaN if the axis is unclear,
/// T and W if the heights are not known.
struct ObjectShape {
  double elongation, skew, fill, height, slimness;
};
ObjectShape shape_of(const ObjectAxis& axis, const Heights& heights);

/// x = (φ - 65) / 15.
double scaled_elevation(const view::CameraPose& pose);

/// φ >= 89.5: the azimuth does not matter.
bool is_top(const view::CameraPose& pose);

/// The inputs in the order above. Two directions that differ by a whole turn have the same inputs, up to rounding.
/// Throws Error for a pose that is out of range (view/camera_pose.h). Heights are not used without options.heights.
std::vector<double> pose_inputs(const ObjectAxis&, const Heights&, const view::CameraPose&,
                                const PoseInputOptions& = {});

/// Writes the same inputs, those of groups of the shape (is_of_shape) multiplied by `trust`, and returns how many there
/// are. Requires room for them. Allocates nothing.
std::size_t write_pose_inputs(const ObjectAxis&, const Heights&, const view::CameraPose&, const PoseInputOptions&,
                              double trust, std::span<double> inputs);

/// The name of each input, such as "a2*x": what the list above calls it.
std::vector<std::string> pose_input_names(const PoseInputOptions& = {});

/// The group of each input.
std::vector<InputGroup> pose_input_groups(const PoseInputOptions& = {});

}  // namespace svnet::frame
