#include "localise/localise.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "localise/enclosing_circle.h"
#include "simulation/catalogue.h"
#include "simulation/collection.h"
#include "simulation/sculptor.h"

using namespace svnet;
using namespace svnet::localise;
using namespace svnet::simulation;

namespace {

/// A block of 120 x 60 x 40 mm with its edges along the table's axes.
Mesh block() {
  Sculptor sculptor;
  sculptor.use({.colour = {0.7f, 0.1f, 0.05f}});
  sculptor.box(120, 60, 40, 0.5f);
  return sculptor.take();
}

/// The table and the light of a simple room.
Setting plain_setting() {
  Setting setting;
  setting.table.colour = setting.table.second = {0.5f, 0.5f, 0.5f};
  setting.table.gloss = 0;
  setting.lamps.push_back({{0.5f, 0.5f, 1.5f}, 0.2f, {0.6f, 0.6f, 0.6f}});
  return setting;
}

/// The overview of `mesh` at (x, y) on the table, or of the table alone.
RgbdImage image(const Mesh* mesh, double x_m, double y_m, float exposure, std::uint32_t number) {
  Eigen::Isometry3d place(Eigen::Translation3d(x_m, y_m, 0.02));
  const Scene scene(mesh, place, plain_setting());
  return sensor_image(scene.shoot(overview_camera(), overview_camera_to_world(), {5, number}, 2), {5, number},
                      exposure);
}

LocalisedObject find(const RgbdImage& before, const RgbdImage& after, const LocaliseOptions& options = {}) {
  return localise::locate(overview_camera(), overview_camera_to_world(), {before.rgb, before.depth},
                          {after.rgb, after.depth}, options);
}

std::string refusal(const RgbdImage& before, const RgbdImage& after) {
  try {
    find(before, after);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "found";
}

}  // namespace

TEST_CASE("a block is found with its place and size, after a small change of the light") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1);
  for (const float exposure : {0.95f, 1.0f, 1.05f}) {
    const LocalisedObject object = find(before, image(&mesh, 0.05, -0.03, exposure, 2), {.keep_steps = true});
    INFO("exposure " << exposure);
    CHECK(object.centre_m.x() == Approx(0.05).margin(0.002));
    CHECK(object.centre_m.y() == Approx(-0.03).margin(0.002));
    CHECK(object.centre_m.z() == Approx(0.02).margin(0.002));
    CHECK(object.length_m == Approx(0.12).margin(0.003));
    CHECK(object.width_m == Approx(0.06).margin(0.003));
    CHECK(object.height_m == Approx(0.04).margin(0.003));
    CHECK(std::abs(std::sin(object.yaw_rad)) < 0.05);
    CHECK(object.diagonal_m == Approx(std::sqrt(0.12 * 0.12 + 0.06 * 0.06 + 0.04 * 0.04)).margin(0.004));
    REQUIRE(object.steps.size() == 4);
    for (const Image& step : object.steps) CHECK(step.width == 640);
  }
}

TEST_CASE("pixels without depth are tolerated") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1);
  RgbdImage after = image(&mesh, 0, 0, 1, 2);
  for (std::size_t i = 0; i < after.depth.metres.size(); i += 3) after.depth.metres[i] = 0;
  for (std::size_t i = 1; i < after.depth.metres.size(); i += 7) after.depth.metres[i] = std::nanf("");
  const LocalisedObject object = find(before, after);
  CHECK(object.length_m == Approx(0.12).margin(0.004));
  CHECK(object.height_m == Approx(0.04).margin(0.004));
}

TEST_CASE("a knife on its edge is found up to its tip, although its blade looks like a shadow from above") {
  const Mesh mesh = catalogue_object("knife", 2, 6);
  for (const std::uint64_t seed : {1, 2, 3}) {
    INFO("seed " << seed);
    const PosedObject posed = pose_object(mesh, 1, seed, 7);
    const Overview overview = capture_overview(posed, seed, 7);
    CHECK(find(overview.background, overview.current).length_m == Approx(0.315).margin(0.008));
  }
}

TEST_CASE("nothing, a part of an object, and several objects are refused") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1);
  CHECK_THAT(refusal(before, image(nullptr, 0, 0, 1.03f, 3)), Catch::StartsWith("[localise] nothing is found"));
  CHECK_THAT(refusal(before, image(&mesh, 0.5, 0, 1, 4)),
             Catch::StartsWith("[localise] the object is cut off by the border of the image"));
  // Two images put together, one half from each.
  RgbdImage two = image(&mesh, -0.2, 0, 1, 5);
  const RgbdImage other = image(&mesh, 0.2, 0, 1, 6);
  for (Index y = 0; y < 480; ++y) {
    // World x points to the left in this overview.
    std::copy_n(other.rgb.rgb.begin() + 3 * 640 * y, 3 * 320, two.rgb.rgb.begin() + 3 * 640 * y);
    std::copy_n(other.depth.metres.begin() + 640 * y, 320, two.depth.metres.begin() + 640 * y);
  }
  CHECK(refusal(before, two) == "[localise] there are 2 objects; leave one on the table, or ask for the largest");
  CHECK(find(before, two, {.take_largest = true}).length_m == Approx(0.12).margin(0.006));
}

TEST_CASE("the soft enclosing circle is the smallest one for certain points, and more robust for uncertain ones") {
  const std::vector<cv::Point2f> square{{0, 0}, {80, 0}, {80, 80}, {0, 80}};
  const cv::Point2d middle = soft_enclosing_centre(square, 0.5);
  CHECK(middle.x == Approx(40).margin(1e-3));
  CHECK(middle.y == Approx(40).margin(1e-3));

  // The tip of a handle and the corners of the head; one corner was measured a millimetre too far out.
  const std::vector<cv::Point2f> fork{{0, 0}, {200, -12}, {200, 12}}, seen{{0, 0}, {201, -12}, {200, 12}};
  const auto exact = [](const std::vector<cv::Point2f>& points) {
    cv::Point2f centre;
    float radius = 0;
    cv::minEnclosingCircle(points, centre, radius);
    return cv::Point2d(centre);
  };
  CHECK(cv::norm(soft_enclosing_centre(fork, 0.001) - exact(fork)) < 0.01);
  CHECK(cv::norm(soft_enclosing_centre(fork, 0.5) - exact(fork)) < 1);
  CHECK(cv::norm(exact(seen) - exact(fork)) > 4);
  CHECK(cv::norm(soft_enclosing_centre(seen, 0.5) - exact(fork)) < 2.5);

  const cv::Point2d alone = soft_enclosing_centre({{3, 4}}, 0.5);
  CHECK(alone.x == Approx(3));
  CHECK(alone.y == Approx(4));
}

TEST_CASE("exchanged images and a camera upside down are refused") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1), after = image(&mesh, 0.05, 0, 1, 4);
  CHECK_THAT(refusal(after, before), Catch::Contains("below the table; are the images of the table and of the object "
                                                     "exchanged?"));
  CHECK_THROWS_WITH(localise::locate(overview_camera(), Eigen::Isometry3d::Identity(), {before.rgb, before.depth},
                                     {after.rgb, after.depth}),
                    Catch::StartsWith("[localise] the camera looks upwards"));
}

TEST_CASE("images of another size than the camera's are refused") {
  const RgbdImage before = image(nullptr, 0, 0, 1, 1);
  RgbdImage small = before;
  small.rgb = {2, 2, std::vector<std::uint8_t>(12)};
  CHECK(refusal(before, small) == "[localise] the current image has 2x2 pixels, the camera 640x480");
  small = before;
  small.depth = {2, 3, std::vector<float>(6)};
  CHECK(refusal(small, before) == "[localise] the background depth image has 3x2 pixels, the camera 640x480");
}

namespace {

/// Errors in millimetres: x, y, z of GC, length, width, height. 1000 if the object is not found.
using Errors = std::array<double, 6>;

/// The seeds of objects, poses and images. Localisation was developed on the first pair, and on (101, 103), (201,
/// 202) to (207, 208), not on the others.
struct Seeds {
  std::uint32_t shapes, poses;
};
constexpr Seeds kDevelopment{1, 3}, kFresh[] = {{301, 302}, {303, 304}, {305, 306}};

/// Localises `count` objects of the catalogue, category by category, each in another pose.
std::vector<Errors> overview_errors(Index count, const Seeds& seeds) {
  const auto& names = catalogue_names();
  const auto categories = static_cast<Index>(names.size());
  std::vector<Errors> errors(static_cast<std::size_t>(count));
  Parallel::shared().for_chunks(count, 1, [&](Index i, Index, int) {
    const Mesh mesh = catalogue_object(names[static_cast<std::size_t>(i % categories)], i / categories, seeds.shapes);
    const auto number = static_cast<std::uint32_t>(i);
    const PosedObject posed = pose_object(mesh, i / categories % 3, seeds.poses, number);
    const Overview overview = capture_overview(posed, seeds.poses, number);
    std::vector<cv::Point2f> seen_from_above;
    double height = 0;
    for (const Vec3& point : mesh.points) {
      const Eigen::Vector3d at = 1000 * (posed.object_to_world * point.cast<double>());
      seen_from_above.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()));
      height = std::max(height, at.z());
    }
    const cv::Size2f size = cv::minAreaRect(seen_from_above).size;
    cv::Point2f middle;
    float radius = 0;
    cv::minEnclosingCircle(seen_from_above, middle, radius);
    Errors& error = errors[static_cast<std::size_t>(i)];
    error.fill(1000);
    try {
      const LocalisedObject found = find(overview.background, overview.current);
      error = {1000 * found.centre_m.x() - static_cast<double>(middle.x),
               1000 * found.centre_m.y() - static_cast<double>(middle.y),
               1000 * found.centre_m.z() - height / 2,
               1000 * found.length_m - static_cast<double>(std::max(size.width, size.height)),
               1000 * found.width_m - static_cast<double>(std::min(size.width, size.height)),
               1000 * found.height_m - height};
    } catch (const std::exception&) {
      // stays at 1000
    }
  });
  return errors;
}

/// The quantile of the errors: a fraction of the objects does not exceed it.
double percentile(const std::vector<Errors>& errors, std::size_t which, double share) {
  std::vector<double> sizes;
  for (const Errors& error : errors) sizes.push_back(std::abs(error[which]));
  std::sort(sizes.begin(), sizes.end());
  return sizes[static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1))];
}

}  // namespace

TEST_CASE("objects of every category are found within millimetres, except a few that the camera hardly sees",
          "[slow]") {
  const std::vector<Errors> errors = overview_errors(29, kDevelopment);
  const double limits_mm[] = {3, 3, 4, 5, 5, 5};
  for (std::size_t which = 0; which < 6; ++which) {
    INFO("quantity " << which);
    CHECK(percentile(errors, which, 0.5) < 0.4 * limits_mm[which]);
    CHECK(percentile(errors, which, 0.93) < limits_mm[which]);
  }
}

TEST_CASE("localisation of 200 objects, measured", "[.measure]") {
  const double limits_mm[] = {3, 3, 4, 5, 5, 5};
  for (const Seeds& seeds : {kDevelopment, kFresh[0], kFresh[1], kFresh[2]}) {
    const std::vector<Errors> errors = overview_errors(200, seeds);
    for (std::size_t which = 0; which < 6; ++which) {
      WARN("seeds " << seeds.shapes << ", " << seeds.poses << ": "
                    << (std::array{"x", "y", "z", "length", "width", "height"}[which]) << ": median "
                    << percentile(errors, which, 0.5) << ", 90 % " << percentile(errors, which, 0.9) << ", 95 % "
                    << percentile(errors, which, 0.95) << " mm");
      CHECK(percentile(errors, which, 0.95) < limits_mm[which]);
    }
  }
}

namespace {

RgbdImage scaled_depth(RgbdImage image, float factor, double unit_m) {
  for (float& z : image.depth.metres) z *= factor;
  image.depth.unit_m = unit_m;
  return image;
}

std::string refusal_from(const Eigen::Isometry3d& camera_to_world, const RgbdImage& before, const RgbdImage& after,
                         const LocaliseOptions& options = {}) {
  try {
    localise::locate(overview_camera(), camera_to_world, {before.rgb, before.depth}, {after.rgb, after.depth}, options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "found";
}

}  // namespace

TEST_CASE("exchanged images are refused for objects of every height", "[slow]") {
  for (const char* name : {"mug", "bowl", "comb", "fork", "key", "knife", "pen", "plate", "scissors", "spoon"}) {
    INFO(name);
    const Mesh mesh = catalogue_object(name, 1, 3);
    const PosedObject posed = pose_object(mesh, 1, 3, 5);
    const Overview overview = capture_overview(posed, 3, 5);
    CHECK(refusal(overview.background, overview.current) == "found");
    const std::string message = refusal(overview.current, overview.background);
    CHECK_THAT(message, Catch::Contains("exchanged") || Catch::Contains("nothing is found") ||
                            Catch::Contains("objects; leave one"));
  }
}

TEST_CASE("an object without depth is refused, even if the ground of a mug has some") {
  const Mesh mesh = catalogue_object("mug", 1, 3);
  const PosedObject posed = pose_object(mesh, 1, 3, 5);
  const Overview overview = capture_overview(posed, 3, 5);
  RgbdImage walls = overview.current, all = overview.current;
  for (std::size_t i = 0; i < walls.depth.metres.size(); ++i) {
    const float rise = overview.background.depth.metres[i] - walls.depth.metres[i];
    if (rise > 0.009f) walls.depth.metres[i] = 0;
    if (rise > 0.002f) all.depth.metres[i] = 0;
  }
  const auto pattern = Catch::Matches(
      "\\[localise\\] the current depth image has depth at [0-9]+ of the .*[0-9]+ pixels.*, at least [0-9]+ are "
      "needed; "
      "cameras measure none of black, shiny or transparent objects: cover it, or give its place and size");
  CHECK_THAT(refusal(overview.background, walls), pattern || Catch::Contains("of the object's"));
  CHECK_THAT(refusal(overview.background, all), pattern || Catch::Contains("of the object's"));
}

TEST_CASE("a camera that does not look down is refused however its quaternion is rounded") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1), after = image(&mesh, 0, 0, 1, 2);
  for (const double half : {std::sqrt(0.5), 0.7071, 0.707, 0.70711, 0.7072, -0.7071})
    for (const double other : {std::sqrt(0.5), 0.7071, 0.70710678}) {
      Eigen::Isometry3d pose(Eigen::Translation3d(0, 0, 1) *
                             Eigen::Quaterniond(std::copysign(other, half), 0, half, 0).normalized());
      CHECK(
          refusal_from(pose, before, after) ==
          "[localise] the camera looks sideways; give the pose of its optical frame (z forward) in a world with z up");
    }
  Eigen::Isometry3d tilted = overview_camera_to_world() * Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitX());
  CHECK_THAT(refusal_from(tilted, before, after),
             Catch::StartsWith("[localise] the table is tilted by 34 degrees in the world"));
  Eigen::Isometry3d careless = overview_camera_to_world() * Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX());
  CHECK(refusal_from(careless, before, after) == "found");
}

TEST_CASE("depth in another unit is suspected by name") {
  const Mesh mesh = block();
  const RgbdImage before = image(nullptr, 0, 0, 1, 1), after = image(&mesh, 0, 0, 1, 2);
  const Eigen::Isometry3d pose = overview_camera_to_world();
  const struct {
    float factor;
    double unit_m;
    const char *read, *right;
  } cases[] = {{4, 0.001, "mm", "0.25mm"}, {5, 0.001, "mm", "0.2mm"}, {10, 0.001, "mm", "0.1mm"},
               {100, 1, "m", "cm"},        {0.1f, 0.001, "mm", "cm"}, {0.001f, 0.001, "mm", "m"}};
  for (const auto& c : cases) {
    const std::string message =
        refusal_from(pose, scaled_depth(before, c.factor, c.unit_m), scaled_depth(after, c.factor, c.unit_m));
    CHECK_THAT(message, Catch::StartsWith(joined("[localise] with depth in ", c.read, " the table is at z = ")) &&
                            Catch::Contains(joined("with depth in ", c.right, " it is at 0")));
  }
  CHECK(refusal_from(pose, scaled_depth(before, 1, 0.001), scaled_depth(after, 1, 0.001)) == "found");

  // The table is not at z = 0: the distance tells if the object is not found, otherwise its size.
  const Eigen::Isometry3d lifted = Eigen::Translation3d(0, 0, 40) * pose;
  CHECK_THAT(refusal_from(lifted, scaled_depth(before, 100, 1), scaled_depth(after, 100, 1)),
             Catch::Contains("is the unit of depth (m) wrong?") && Catch::Contains("--depth-unit"));
  RgbdImage exact_before = before, exact_after = after;
  for (std::size_t i = 0; i < exact_after.depth.metres.size(); ++i) {
    const bool is_object = before.depth.metres[i] - after.depth.metres[i] > 0.02f;
    exact_before.depth.metres[i] = 1;
    exact_after.depth.metres[i] = is_object ? 0.96f : 1.0f;
  }
  const std::string message =
      refusal_from(lifted, scaled_depth(exact_before, 20, 0.01), scaled_depth(exact_after, 20, 0.01));
  CHECK_THAT(message,
             Catch::StartsWith("[localise] the object is ") &&
                 Catch::Contains("more than the 1.5 m of anything on a table; is the unit of depth (cm) wrong?") &&
                 Catch::Contains(" m with depth in mm"));
}
