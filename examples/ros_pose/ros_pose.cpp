// ros_pose MODEL TOP.png FRAME_ID RADIUS X Y Z: prints where to put the camera, as a ROS geometry_msgs/PoseStamped.
//
// FRAME_ID is a frame whose z axis points upwards, and (X, Y, Z) the centre of the object in it, in metres. theta
// counts from its x axis. The camera is RADIUS metres from the centre and looks at it. The pose is that of the camera's
// optical frame (REP-103: x right, y down, z forward).
//
//   c++ -std=c++17 ros_pose.cpp -o ros_pose $(pkg-config --cflags --libs svnet libpng)
//   ros2 topic pub --once /best_view geometry_msgs/msg/PoseStamped "$(ros_pose model.safetensors top.png table 0.5 0 0
//   0.05)"
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <svnet/svnet.hpp>
#include <vector>

#include <png.h>

namespace {

struct Picture {
  std::int32_t height, width;
  std::vector<std::uint8_t> rgb;  // (height, width, 3)
};

Picture read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str())) throw std::runtime_error(path + ": " + png.message);
  png.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<std::int32_t>(png.height), static_cast<std::int32_t>(png.width), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, picture.rgb.data(), 0, nullptr))
    throw std::runtime_error(path + ": " + png.message);
  return picture;
}

// The top view, and rings of eight poses at elevations of 45, 60 and 75 degrees.
std::vector<svnet::CameraPose> candidates() {
  std::vector<svnet::CameraPose> poses{{90, 90}};
  for (const double phi_deg : {45., 60., 75.})
    for (int i = 0; i < 8; ++i) poses.push_back({45. * i, phi_deg});
  return poses;
}

// Prints the optical frame of a camera that looks at the centre, with a horizontal x axis. The frame of FRAME_ID turned
// by theta + 90° about z has the camera's x axis; a turn by -(90° + phi) about that axis makes z point to the centre.
void print_pose(const svnet::CameraPose& pose, const std::string& frame_id, double radius, double x, double y,
                double z) {
  const double degree = std::acos(-1.) / 180, theta = pose.theta_deg * degree, phi = pose.phi_deg * degree;
  const double about_z = (theta + 90 * degree) / 2, about_x = -(phi + 90 * degree) / 2;
  double qx = std::cos(about_z) * std::sin(about_x), qy = std::sin(about_z) * std::sin(about_x),
         qz = std::sin(about_z) * std::cos(about_x), qw = std::cos(about_z) * std::cos(about_x);
  if (qw < 0) qx = -qx, qy = -qy, qz = -qz, qw = -qw;  // the same rotation
  std::printf("header:\n  frame_id: '%s'\npose:\n", frame_id.c_str());
  std::printf("  position: {x: %.6f, y: %.6f, z: %.6f}\n", x + radius * std::cos(phi) * std::cos(theta),
              y + radius * std::cos(phi) * std::sin(theta), z + radius * std::sin(phi));
  std::printf("  orientation: {x: %.9f, y: %.9f, z: %.9f, w: %.9f}\n", qx, qy, qz, qw);
}

int run(int argc, char** argv) {
  if (argc != 8) {
    std::fprintf(stderr, "usage: ros_pose MODEL TOP.png FRAME_ID RADIUS X Y Z (metres)\n");
    return 2;
  }
  const svnet::ViewModel model(argv[1]);
  if (model.uses_depth()) throw std::runtime_error("the model needs depth too: call model.embed(image, depth_m)");
  const Picture top = read_png(argv[2]);
  const std::vector<svnet::CameraPose> poses = candidates();
  const svnet::BestView best = model.best_view(model.embed({top.rgb.data(), top.height, top.width}), poses);
  std::fprintf(stderr, "theta %g phi %g score %.4f\n", poses[best.index].theta_deg, poses[best.index].phi_deg,
               static_cast<double>(best.score));
  print_pose(poses[best.index], argv[3], std::stod(argv[4]), std::stod(argv[5]), std::stod(argv[6]),
             std::stod(argv[7]));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ros_pose: %s\n", error.what());
    return 1;
  }
}
