// svnet-views: where to bring the camera to see an object, from its place and size or from RGB-D images of it.
#include <array>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command/command.h"
#include "image/depth_unit.h"
#include "io/files/atomic_file.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"
#include "io/views/camera_file.h"
#include "io/views/pose_list_file.h"
#include "localise/localise.h"
#include "view/pose_grid.h"
#include "view/pose_plot.h"
#include "view/reachability.h"

namespace {

using namespace svnet;
using namespace svnet::command;
using svnet::io::CameraFile;
using svnet::localise::LocalisedObject;
using svnet::view::CameraFrame;
using svnet::view::CameraPose;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
  fs::path camera, poses, reachable, csv, json, plot, steps;
  std::vector<fs::path> background, current;
  std::vector<double> centre_m;
  double diagonal_m = 0, lowest_phi_deg = 0;
  Index fibonacci = 0;
  bool largest = false;
  std::string depth_unit;
  std::string frame = name_of(CameraFrame::optical);
};

struct CameraView {
  CameraPose pose;
  Eigen::Isometry3d camera_to_world;
};

/// The numbers of a view, by name, in the order of the columns.
std::vector<std::pair<const char*, double>> fields(const CameraView& view) {
  constexpr double kRadian = std::numbers::pi / 180;
  std::vector<std::pair<const char*, double>> numbers{{"theta", view.pose.theta_deg},
                                                      {"phi", view.pose.phi_deg},
                                                      {"theta_rad", view.pose.theta_deg * kRadian},
                                                      {"phi_rad", view.pose.phi_deg * kRadian}};
  const auto place = view::position_and_orientation(view.camera_to_world);
  numbers.insert(numbers.end(), place.begin(), place.end());
  return numbers;
}

std::string csv_text(const std::vector<CameraView>& views) {
  std::ostringstream text;
  text << std::setprecision(17);
  const char* separator = "";
  for (const auto& [name, unused] : fields(views.front())) text << separator << name, separator = ",";
  text << '\n';
  for (const CameraView& view : views) {
    separator = "";
    for (const auto& [unused, value] : fields(view)) text << separator << value, separator = ",";
    text << '\n';
  }
  return text.str();
}

Json object_json(const LocalisedObject& object) {
  return {{"centre_m", {object.centre_m.x(), object.centre_m.y(), object.centre_m.z()}},
          {"length_m", object.length_m},
          {"width_m", object.width_m},
          {"height_m", object.height_m},
          {"yaw_rad", object.yaw_rad}};
}

LocalisedObject find_object(const Options& options, const CameraFile& camera) {
  check(camera.camera_to_world.has_value(), options.camera.string(),
        ": the key 'pose' is missing, where the camera was for the images");
  std::optional<double> unit_m;
  if (!options.depth_unit.empty()) unit_m = depth_unit_m(options.depth_unit);
  const Image before = io::read_image(options.background[0]), after = io::read_image(options.current[0]);
  const DepthImage depth_before = io::read_depth(options.background[1], unit_m);
  const DepthImage depth_after = io::read_depth(options.current[1], unit_m);
  const localise::LocaliseOptions how{
      .take_largest = options.largest, .keep_steps = !options.steps.empty(), .unit_is_certain = unit_m.has_value()};
  return localise::locate(camera.intrinsics, *camera.camera_to_world, {before, depth_before}, {after, depth_after},
                          how);
}

fs::path step_file(const Options& options, const char* step) { return options.steps / joined(step, ".png"); }

/// Before the work, so that no output takes the place of an input or of another output.
void check_outputs(const Options& options) {
  std::vector<fs::path> others{options.camera, options.poses, options.reachable};
  others.insert(others.end(), options.background.begin(), options.background.end());
  others.insert(others.end(), options.current.begin(), options.current.end());
  std::vector<fs::path> outputs{options.csv, options.json, options.plot};
  if (!options.steps.empty()) {
    std::error_code error;
    fs::create_directories(options.steps, error);
    check(!error, options.steps.string(), ": cannot be made: ", error.message());
    for (const char* step : localise::kLocaliseSteps) outputs.push_back(step_file(options, step));
  }
  for (const fs::path& output : outputs) {
    if (output.empty()) continue;
    check_can_be_written(output, others, io::Streams::allowed);
    others.push_back(output);
  }
}

void write_views(const Options& options, Console& console) {
  check_outputs(options);
  const CameraFile camera = io::read_camera(options.camera);
  const CameraFrame frame = view::camera_frame_named(options.frame);
  Json document;
  Eigen::Vector3d centre;
  double diagonal_m = options.diagonal_m;
  std::vector<Image> steps;
  if (!options.current.empty()) {
    LocalisedObject object = find_object(options, camera);
    steps = std::move(object.steps);
    document["object"] = object_json(object);
    centre = object.centre_m;
    diagonal_m = object.diagonal_m;
  } else {
    centre = {options.centre_m[0], options.centre_m[1], options.centre_m[2]};
    document["object"] = {{"centre_m", options.centre_m}};
  }
  const double radius_m = viewing_radius_m(camera.intrinsics, diagonal_m);
  document["diagonal_m"] = diagonal_m;
  document["radius_m"] = radius_m;
  document["frame"] = name_of(frame);

  std::vector<CameraPose> poses = view::paper_grid();
  if (!options.poses.empty()) poses = io::read_pose_list(options.poses);
  if (options.fibonacci > 0) poses = view::fibonacci_half_sphere(options.fibonacci, options.lowest_phi_deg);
  const view::Reachable reachable = options.reachable.empty()
                                        ? [](const CameraPose&, const Eigen::Isometry3d&) { return true; }
                                        : listed_poses(io::read_pose_list(options.reachable));
  std::vector<CameraView> views;
  std::vector<bool> reached;
  document["views"] = Json::array();
  for (const CameraPose& pose : poses) {
    reached.push_back(reachable(pose, look_at(pose, radius_m, centre, CameraFrame::optical)));
    if (!reached.back()) continue;
    views.push_back({pose, look_at(pose, radius_m, centre, frame)});
    Json entry;
    for (const auto& [name, value] : fields(views.back())) entry[name] = value;
    document["views"].push_back(std::move(entry));
  }
  check(!views.empty(), options.reachable.string(), ": none of the ", poses.size(), " poses is reachable");
  if (!options.csv.empty()) io::write_atomically(options.csv, csv_text(views));
  if (!options.json.empty()) io::write_atomically(options.json, document.dump(2) + "\n");
  if (!options.plot.empty()) io::write_png(options.plot, pose_plot(poses, reached));
  for (std::size_t i = 0; i < steps.size(); ++i)
    io::write_png(step_file(options, localise::kLocaliseSteps[i]), steps[i]);
  for (const fs::path& output : {options.csv, options.json, options.plot})
    if (io::is_standard_output(output)) return;
  if (options.csv.empty() && options.json.empty()) {
    std::string text = csv_text(views);
    text.pop_back();
    console.result(text);
  } else {
    console.result(
        joined(views.size(), " views at ", radius_m, " m from (", centre.x(), ", ", centre.y(), ", ", centre.z(), ")"));
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): CLI11 throws for options that contradict each other, which is seen at once
int main(int argc, char** argv) {
  Command command("svnet-views",
                  "Says where to bring the camera to see an object from the half-sphere around it, at the distance at "
                  "which it fills 70 % of the image. The object's place and size are given, or measured in RGB-D "
                  "images of the empty table and of the object. Prints CSV, unless --csv or --json says where to "
                  "write: theta and phi in degrees and radians, the "
                  "camera's position in metres, its orientation as a quaternion (docs/camera-convention.md).",
                  "svnet-views camera.json --centre 0.4 0 0.05 --diagonal 0.2 --json views.json --plot views.png\n"
                  "svnet-views camera.json --background empty.png empty_depth.png --current now.png now_depth.png");
  Options options;
  command
      .add(
          "CAMERA", options.camera,
          "JSON or YAML: width, height, fx, fy, cx, cy in pixels, or a ROS camera_info or RealSense intrinsics without "
          "distortion; for --current also pose (x_m, y_m, z_m, qx, qy, qz, qw of the optical frame in the world, z "
          "upwards)")
      .required();
  const Argument centre =
      command.add("--centre", options.centre_m, "The object's geometric centre in the world, metres")
          .exactly(3)
          .value_name("X Y Z");
  const Argument diagonal =
      command.add("--diagonal", options.diagonal_m, "sqrt(length^2 + width^2 + height^2), metres").positive();
  centre.needs(diagonal);
  diagonal.needs(centre);
  const Argument background =
      command.add("--background", options.background, "The empty table: an image, and depth as 16-bit PNG or .npy")
          .exactly(2);
  const Argument current = command.add("--current", options.current, "The same with the object").exactly(2);
  background.needs(current).excludes(centre);
  current.needs(background);
  command.add_flag("--largest", options.largest, "Of several objects take the largest").needs(current);
  command
      .add("--depth-unit", options.depth_unit,
           "The unit of depth: m, cm, mm, 0.25mm (RealSense L515), 0.2mm (TUM RGB-D) or the like, or metres per unit; "
           "default: integers are millimetres, floats metres")
      .needs(current);
  command.add("--steps", options.steps, "A folder for images of each step of the localisation").needs(current);
  const Argument poses =
      command.add("--poses", options.poses, "CSV with the header theta,phi in place of the paper's grid");
  const Argument fibonacci =
      command.add("--fibonacci", options.fibonacci, "N poses spread evenly over the half-sphere instead")
          .in_range(1, 100000)
          .excludes(poses);
  command.add("--lowest-phi", options.lowest_phi_deg, "Their lowest elevation in degrees (0)").needs(fibonacci);
  command.add("--reachable", options.reachable, "CSV with the header theta,phi of the poses that the robot can reach");
  command
      .add("--frame", options.frame,
           "Axes of the orientation: optical (ROS: z forward, x right, y down; default) or "
           "paper (z forward, x left, y up)")
      .one_of(names_of<CameraFrame>());
  command.add("--csv", options.csv, "Writes CSV to a file");
  command.add("--json", options.json, "Writes JSON to a file");
  command.add("--plot", options.plot, "Writes an image of the half-sphere from above: filled dots can be reached");
  return command.run(argc, argv, [&](Console& console) {
    if (options.current.empty() && options.centre_m.empty())
      wrong_usage("either --centre and --diagonal, or --background and --current");
    write_views(options, console);
  });
}
