#include "view/camera.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"

using namespace svnet;
using namespace svnet::view;
using Eigen::Vector3d;

namespace {

struct Case {
  Intrinsics camera;
  CameraPose pose;
  Vector3d centre_m;
  double diagonal_m;
};

/// A random camera, camera pose and object; every seventh is a top view.
Case random_case(std::uint64_t number) {
  RandomStream random(7, Stream::collection, number);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  Case c;
  c.camera = {200 + random.below(1800), 200 + random.below(1800), between(150, 3000), 0, 0, 0};
  c.camera.fy = c.camera.fx * between(0.8, 1.25);
  c.camera.cx = between(0.4, 0.6) * static_cast<double>(c.camera.width);
  c.camera.cy = between(0.4, 0.6) * static_cast<double>(c.camera.height);
  c.pose = {between(-360, 720), number % 7 == 0 ? 90 : between(0, 90)};
  c.centre_m = {between(-2, 2), between(-2, 2), between(-1, 1)};
  c.diagonal_m = between(0.01, 2);
  return c;
}

}  // namespace

TEST_CASE("500 camera poses are rotations that look at the centre, level, from the right place") {
  for (std::uint64_t number = 0; number < 500; ++number) {
    const auto [camera, pose, centre, diagonal] = random_case(number);
    INFO("case " << number << ": theta " << pose.theta_deg << ", phi " << pose.phi_deg);
    const double radius = viewing_radius_m(camera, diagonal);
    const auto paper = look_at(pose, radius, centre, CameraFrame::paper);
    const auto optical = look_at(pose, radius, centre, CameraFrame::optical);
    for (const auto& frame : {paper, optical}) {
      const Eigen::Matrix3d rotation = frame.linear();
      CHECK((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12);
      CHECK(std::abs(rotation.determinant() - 1) < 1e-12);
      CHECK((frame.translation() - centre).norm() == Approx(radius).epsilon(1e-12));
      CHECK((rotation.col(2) - (centre - frame.translation()) / radius).norm() < 1e-12);
      CHECK(std::abs(rotation(2, 0)) < 1e-12);
    }
    CHECK(paper.linear()(2, 1) > -1e-12);   // y upwards
    CHECK(optical.linear()(2, 1) < 1e-12);  // y down
    CHECK((paper.linear().col(0) + optical.linear().col(0)).norm() < 1e-12);
    const Vector3d above = paper.translation() - centre;
    CHECK(above.z() == Approx(radius * std::sin(pose.phi_deg * EIGEN_PI / 180)).margin(1e-12));

    const auto world_to_camera = optical.inverse();
    const Eigen::Vector2d seen = projected_px(camera, world_to_camera * centre);
    CHECK(std::abs(seen.x() - camera.cx) < 1e-6);
    CHECK(std::abs(seen.y() - camera.cy) < 1e-6);

    // The diagonal spans 70 % of the side with the smaller angle of view.
    const bool across = camera.fx / static_cast<double>(camera.width) > camera.fy / static_cast<double>(camera.height);
    const Vector3d half = optical.linear().col(across ? 0 : 1) * diagonal / 2;
    const double span_px = (projected_px(camera, world_to_camera * (centre + half)) -
                            projected_px(camera, world_to_camera * (centre - half)))
                               .norm();
    const double side_px = static_cast<double>(across ? camera.width : camera.height);
    CHECK(span_px / side_px == Approx(0.7).margin(0.001));
  }
}

TEST_CASE("with square pixels the radius is the paper's f d / (0.7 min(w, h))") {
  CHECK(viewing_radius_m({640, 480, 600, 600, 320, 240}, 0.2) == Approx(600 * 0.2 / (0.7 * 480)));
  CHECK(viewing_radius_m({480, 640, 600, 600, 240, 320}, 0.2) == Approx(600 * 0.2 / (0.7 * 480)));
}

TEST_CASE("at angles 0 the axes are those of the documentation") {
  const auto pose = [](double theta, double phi, CameraFrame frame) {
    return look_at({theta, phi}, 2, {1, 1, 1}, frame);
  };
  const auto side = pose(0, 0, CameraFrame::paper);  // on the x axis, level with the centre
  CHECK(side.translation().isApprox(Vector3d(3, 1, 1)));
  CHECK(side.linear().col(0).isApprox(Vector3d(0, -1, 0)));
  CHECK(side.linear().col(1).isApprox(Vector3d(0, 0, 1)));
  CHECK(side.linear().col(2).isApprox(Vector3d(-1, 0, 0)));
  const auto top = pose(90, 90, CameraFrame::optical);
  CHECK(top.translation().isApprox(Vector3d(1, 1, 3)));
  CHECK(top.linear().col(0).isApprox(Vector3d(-1, 0, 0)));  // the image's right
  CHECK(top.linear().col(1).isApprox(Vector3d(0, 1, 0)));   // the image's lower side: towards a camera at theta 90
  CHECK(top.linear().col(2).isApprox(Vector3d(0, 0, -1)));
  // The top view is the limit of views from the same azimuth.
  CHECK((pose(40, 90, CameraFrame::paper).linear() - pose(40, 90 - 1e-7, CameraFrame::paper).linear()).norm() < 1e-8);
}

TEST_CASE("deprojection undoes projection") {
  const Intrinsics camera{640, 480, 610, 600, 300, 250};
  const Vector3d point(0.1, -0.2, 0.7);
  const Eigen::Vector2d pixel = projected_px(camera, point);
  CHECK(deprojected_m(camera, pixel.x(), pixel.y(), point.z()).isApprox(point));
}

TEST_CASE("impossible cameras and poses are refused") {
  const Intrinsics good{640, 480, 600, 600, 320, 240};
  CHECK(intrinsics_problem(good).empty());
  Intrinsics bad = good;
  bad.width = 0;
  CHECK(intrinsics_problem(bad) == "the image has 0x480 pixels, expected a positive width and height");
  bad = good;
  bad.fy = -1;
  CHECK(intrinsics_problem(bad) == "fy is -1, expected a positive number of pixels");
  bad = good;
  bad.cx = 640;
  CHECK(intrinsics_problem(bad) == "cx is 640, which is outside the image of 640 pixels");
  bad.cx = std::nan("");
  CHECK(intrinsics_problem(bad) == "cx is nan, which is outside the image of 640 pixels");
  CHECK_THROWS_WITH(viewing_radius_m(bad, 1), "[view] cx is nan, which is outside the image of 640 pixels");
  CHECK_THROWS_WITH(viewing_radius_m(good, 0), "[view] the object's diagonal is 0 m, expected a positive length");
  CHECK_THROWS_WITH(look_at({0, 91}, 1, Vector3d::Zero(), CameraFrame::paper),
                    "[view] phi 91 is outside [0, 90] degrees");
  CHECK_THROWS_WITH(look_at({0, 45}, -1, Vector3d::Zero(), CameraFrame::paper),
                    "[view] the radius is -1 m, expected a positive length");
  CHECK_THROWS_WITH(look_at({0, 45}, 1, {0, 0, std::nan("")}, CameraFrame::paper), Catch::Contains("is not finite"));
  CHECK_THROWS_WITH(camera_frame_named("ros"), "the camera frame 'ros' is not known; known: paper, optical");
  CHECK(camera_frame_named(name_of(CameraFrame::optical)) == CameraFrame::optical);
}
