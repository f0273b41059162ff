#include "serve/camera_place.h"

#include <nlohmann/json.hpp>

namespace svnet::serve {

CameraPlace camera_place(FieldValues& fields) {
  CameraPlace place;
  place.radius_m = fields.number("radius_m", place.radius_m);
  expect(place.radius_m > 0, 400, "radius_m: ", place.radius_m, " is not positive");
  if (const auto text = fields.take("centre_m")) {
    const std::vector<double> centre = numbers_in("centre_m", *text);
    expect(centre.size() == 3, 400, "centre_m: has ", centre.size(), " numbers, expected x,y,z");
    place.centre_m = {centre[0], centre[1], centre[2]};
  }
  place.frame = fields.choice("frame", place.frame);
  return place;
}

nlohmann::ordered_json camera_pose_json(const view::CameraPose& pose, const CameraPlace& place) {
  using Json = nlohmann::ordered_json;
  const Eigen::Isometry3d camera = view::look_at(pose, place.radius_m, place.centre_m, place.frame);
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column) numbers.push_back(camera.matrix()(row, column) + 0.0);  // not -0
    rows.push_back(std::move(numbers));
  }
  Json json{{"frame", name_of(place.frame)},
            {"radius_m", place.radius_m},
            {"centre_m", {place.centre_m.x(), place.centre_m.y(), place.centre_m.z()}}};
  for (const auto& [name, number] : view::position_and_orientation(camera)) json[name] = number;
  json["camera_to_world"] = std::move(rows);
  return json;
}

}  // namespace svnet::serve
