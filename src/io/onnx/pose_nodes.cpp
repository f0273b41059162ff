#include "io/onnx/pose_nodes.h"

#include <array>
#include <numbers>
#include <vector>

#include "view/symmetry.h"

namespace svnet::io {
namespace {

/// Adds operations on angles, whose names begin with "angles/".
class PoseNodes {
 public:
  explicit PoseNodes(OnnxGraph& to) : to_(to) {}

  /// (M, 2) as (1, M, 2), so that it has the rank of what it meets.
  std::string as_batch(const std::string& poses) {
    const std::array<std::int64_t, 3> shape{1, -1, 2};
    return to_.add("Reshape", text("poses"), {poses, to_.add_constant(text("shape"), {3}, shape)});
  }

  /// The column of (…, 2) as (…, 1).
  std::string column(const std::string& poses, const char* name, std::size_t index) {
    std::array<float, 2> chosen{};
    chosen[index] = 1;
    return to_.add("MatMul", text(name), {poses, to_.add_constant(text("column_of_", name), {2, 1}, chosen)});
  }
  std::string unary(const char* op, const char* name, const std::string& value) {
    return to_.add(op, text(name), {value});
  }
  std::string with(const char* op, const char* name, const std::string& value, double number) {
    const std::array<float, 1> numbers{static_cast<float>(number)};
    return to_.add(op, text(name), {value, to_.add_constant(text("number_of_", name), {1}, numbers)});
  }
  std::string product(const char* name, const std::string& a, const std::string& b) {
    return to_.add("Mul", text(name), {a, b});
  }
  std::string side_by_side(const std::vector<std::string>& parts) {
    return to_.add("Concat", "angles", parts, {{"axis", std::int64_t{-1}}});
  }

  /// The azimuths, each in [0, 360): of (M, 1), or of (1, M, 1) in all symmetries, (symmetries, M, 1).
  std::string azimuths(const std::string& theta, int symmetries) {
    std::string turned = theta;
    if (symmetries > 1) {
      std::vector<float> signs, offsets;
      for (int symmetry = 0; symmetry < symmetries; ++symmetry) {
        const double at_0 = view::symmetric_theta_deg(symmetry, 0), at_1 = view::symmetric_theta_deg(symmetry, 1);
        const bool grows = at_1 - at_0 == 1;  // at_0 is a multiple of 90 below 360
        signs.push_back(grows ? 1.0f : -1.0f);
        offsets.push_back(static_cast<float>(at_0));
      }
      turned = to_.add("Mul", text("mirrored"), {theta, to_.add_constant(text("signs"), {symmetries, 1, 1}, signs)});
      turned = to_.add("Add", text("turned"), {turned, to_.add_constant(text("offsets"), {symmetries, 1, 1}, offsets)});
    }
    const std::string turns = unary("Floor", "turns", with("Mul", "in_turns", turned, 1 / 360.0));
    return to_.add("Sub", text("azimuth"), {turned, with("Mul", "whole_turns", turns, 360)});
  }

  /// phi of (1, M, 1) for all symmetries, (symmetries, M, 1).
  std::string repeated(const std::string& phi, int symmetries) {
    if (symmetries == 1) return phi;
    const std::vector<float> zeros(static_cast<std::size_t>(symmetries), 0.0f);
    return to_.add("Add", text("elevation"), {phi, to_.add_constant(text("zeros"), {symmetries, 1, 1}, zeros)});
  }

 private:
  static std::string text(const char* a, const char* b = "") { return std::string("angles/") + a + b; }
  OnnxGraph& to_;
};

}  // namespace

std::string add_angles(OnnxGraph& to, const std::string& poses, models::AngleEncoding encoding, int symmetries) {
  using models::AngleEncoding;
  constexpr double kRadian = std::numbers::pi / 180;
  PoseNodes nodes(to);
  const std::string rows = symmetries > 1 ? nodes.as_batch(poses) : poses;
  const std::string theta = nodes.azimuths(nodes.column(rows, "theta", 0), symmetries);
  const std::string phi = nodes.repeated(nodes.column(rows, "phi", 1), symmetries);
  const std::string theta_rad = nodes.with("Mul", "theta_rad", theta, kRadian);
  const std::string phi_rad = nodes.with("Mul", "phi_rad", phi, kRadian);
  if (encoding == AngleEncoding::radians)
    return nodes.side_by_side({nodes.with("Sub", "theta_from_pi", theta_rad, std::numbers::pi),
                               nodes.with("Sub", "phi_from_pi", phi_rad, std::numbers::pi)});
  const std::string level = nodes.unary("Cos", "cos_phi", phi_rad);
  const std::string cos_theta = nodes.unary("Cos", "cos_theta", theta_rad),
                    sin_theta = nodes.unary("Sin", "sin_theta", theta_rad);
  if (encoding == AngleEncoding::sphere)
    return nodes.side_by_side(
        {nodes.product("x", level, cos_theta), nodes.product("y", level, sin_theta), nodes.unary("Sin", "z", phi_rad)});
  constexpr double kStrength = 4;  // as in models/sv_net.cpp
  const std::string strong = nodes.with("Mul", "level", level, kStrength * std::numbers::sqrt2);
  const std::string theta2 = nodes.with("Mul", "theta2_rad", theta_rad, 2);
  const std::string rise =
      nodes.with("Mul", "elevation_scaled", nodes.with("Sub", "phi_from_65", phi, 65), kStrength / 15);
  return nodes.side_by_side({nodes.product("x", strong, cos_theta), nodes.product("y", strong, sin_theta),
                             nodes.product("x2", strong, nodes.unary("Cos", "cos_theta2", theta2)),
                             nodes.product("y2", strong, nodes.unary("Sin", "sin_theta2", theta2)), rise});
}

}  // namespace svnet::io
