#include "serve/prediction_request.h"

#include "base/text.h"
#include "image/depth_unit.h"
#include "serve/field_values.h"
#include "serve/refusal.h"
#include "view/pose_grid.h"

namespace svnet::serve {
namespace {

enum class Grid { paper, even };
constexpr auto enum_table(Grid) {
  return std::to_array<EnumName<Grid>>({{Grid::paper, "paper"}, {Grid::even, "even"}});
}

constexpr double kCount = 400, kLowestPhi_deg = 45;

std::vector<view::CameraPose> listed_poses(std::string_view text, Index most_poses) {
  std::vector<view::CameraPose> poses;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    const std::vector<double> angles = numbers_in("poses", item);
    expect(angles.size() == 2, 400, "poses: '", printable(item.substr(0, 40)), "' is no pair theta,phi");
    expect(static_cast<Index>(poses.size()) < most_poses, 400, "poses: more than ", most_poses);
    poses.push_back({angles[0], angles[1]});
    const std::string problem = pose_problem(poses.back());
    expect(problem.empty(), 400, "poses: ", problem);
  }
  expect(!poses.empty(), 400, "poses: is empty, expected theta,phi;theta,phi in degrees");
  return poses;
}

std::vector<view::CameraPose> grid_poses(FieldValues& fields, Index most_poses) {
  switch (fields.choice("grid", Grid::paper)) {
    case Grid::paper:
      return view::paper_grid();
    case Grid::even:
      break;
  }
  const double count = fields.number("count", std::min(kCount, static_cast<double>(most_poses)));
  expect(count >= 1 && count <= static_cast<double>(most_poses) && count == std::floor(count), 400, "count: ", count,
         " is no whole number from 1 to ", most_poses);
  const double lowest_phi_deg = fields.number("lowest_phi_deg", kLowestPhi_deg);
  expect(lowest_phi_deg >= 0 && lowest_phi_deg < 90, 400, "lowest_phi_deg: ", lowest_phi_deg, " is outside [0, 90)");
  return view::fibonacci_half_sphere(static_cast<Index>(count), lowest_phi_deg);
}

}  // namespace

PredictionRequest prediction_request(const Fields& given, Index most_poses) {
  FieldValues fields(given);
  PredictionRequest request;
  const std::optional<std::string> poses = fields.take("poses");
  request.poses = poses ? listed_poses(*poses, most_poses) : grid_poses(fields, most_poses);
  request.exif = fields.choice("exif_orientation", ExifOrientation::ignore);
  if (const auto unit = fields.take("depth_unit")) request.depth_unit_m = depth_unit_m(*unit);
  request.place = camera_place(fields);
  fields.check_all_taken();
  return request;
}

}  // namespace svnet::serve
