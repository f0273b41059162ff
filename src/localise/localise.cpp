#include "localise/localise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "base/error.h"
#include "image/depth_unit.h"
#include "image/opencv_image.h"
#include "localise/enclosing_circle.h"
#include "localise/foreground.h"

namespace svnet::localise {
using view::Intrinsics;

namespace {

void check_fits(const Intrinsics& camera, const RgbdView& view, const char* which) {
  check(view.rgb.width == camera.width && view.rgb.height == camera.height, "[localise] the ", which, " image has ",
        view.rgb.width, "x", view.rgb.height, " pixels, the camera ", camera.width, "x", camera.height);
  check(view.depth.width == camera.width && view.depth.height == camera.height, "[localise] the ", which,
        " depth image has ", view.depth.width, "x", view.depth.height, " pixels, the camera ", camera.width, "x",
        camera.height);
}

/// Values that are not a depth become 0, not measured.
cv::Mat1f depth_of(const DepthImage& image) {
  cv::Mat1f depth(static_cast<int>(image.height), static_cast<int>(image.width));
  std::transform(image.metres.begin(), image.metres.end(), depth.begin(),
                 [](float z) { return std::isfinite(z) && z > 0 ? z : 0.0f; });
  return depth;
}

Image image_of(const cv::Mat& image) {
  cv::Mat3b rgb;
  if (image.channels() == 1)
    cv::cvtColor(image, rgb, cv::COLOR_GRAY2RGB);
  else
    rgb = image;
  Image result{rgb.rows, rgb.cols, {}};
  for (int y = 0; y < rgb.rows; ++y) result.rgb.insert(result.rgb.end(), rgb.ptr(y), rgb.ptr(y) + 3 * rgb.cols);
  return result;
}

/// The height in the world that most of a depth image has: that of the table.
std::optional<double> common_height_m(const Intrinsics& camera, const Eigen::Isometry3d& camera_to_world,
                                      const cv::Mat1f& depth) {
  constexpr int kStep_px = 4;
  std::vector<double> heights;
  for (int y = 0; y < depth.rows; y += kStep_px)
    for (int x = 0; x < depth.cols; x += kStep_px)
      if (depth(y, x) > 0) heights.push_back((camera_to_world * deprojected_m(camera, x, y, depth(y, x))).z());
  if (heights.empty()) return std::nullopt;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

/// Throws Error if the table lies far from the world's z = 0, but near it if depth is read in another of kDepthUnits.
void check_unit(double unit_m, double camera_m, double table_m) {
  constexpr double kFar_m = 0.3, kNearShare = 0.05;
  if (unit_m <= 0 || std::abs(table_m) < kFar_m) return;
  const DepthUnit* best = nullptr;
  double best_table_m = kNearShare * std::abs(camera_m);
  for (const DepthUnit& unit : kDepthUnits) {
    const double other_m = camera_m - (camera_m - table_m) * unit.metres / unit_m;
    if (std::abs(other_m) < best_table_m) best = &unit, best_table_m = std::abs(other_m);
  }
  check(best == nullptr, "[localise] with depth in ", depth_unit_name(unit_m), " the table is at z = ", table_m,
        " m in the world, with depth in ", best == nullptr ? "" : best->name,
        " it is at 0: the unit is probably wrong; give it (--depth-unit)");
}

/// Throws Error unless the table around the object is horizontal in the world, up to what a careless calibration does.
void check_horizontal(const Intrinsics& camera, const Eigen::Isometry3d& camera_to_world, const cv::Mat1f& background,
                      const cv::Mat1b& object) {
  constexpr int kLeastMargin_px = 40, kRounds = 4;
  constexpr double kSteepest_deg = 20;
  const cv::Rect box = cv::boundingRect(object);
  const int margin = std::max({kLeastMargin_px, box.width / 2, box.height / 2});
  const cv::Rect region = cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
                          cv::Rect(0, 0, background.cols, background.rows);
  std::vector<Eigen::Vector3d> points;
  for (int y = region.y; y < region.br().y; y += 2)
    for (int x = region.x; x < region.br().x; x += 2)
      if (background(y, x) > 0) points.push_back(deprojected_m(camera, x, y, background(y, x)));
  constexpr std::size_t kLeast = 200;
  if (points.size() < kLeast) return;
  // Least squares of z = a x + b y + c, repeated with the two thirds of the points that are nearest to the plane.
  std::vector<Eigen::Vector3d> kept = points;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : kept) {
      const Eigen::Vector3d row(p.x(), p.y(), 1);
      normal += row * row.transpose();
      right += row * p.z();
    }
    plane = normal.ldlt().solve(right);
    const auto error = [&](const Eigen::Vector3d& p) {
      return std::abs(plane.dot(Eigen::Vector3d(p.x(), p.y(), 1)) - p.z());
    };
    const auto end = points.begin() + static_cast<std::ptrdiff_t>(points.size() * 2 / 3);
    std::nth_element(points.begin(), end, points.end(),
                     [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return error(p) < error(q); });
    kept.assign(points.begin(), end);
  }
  const Eigen::Vector3d up = camera_to_world.linear() * Eigen::Vector3d(plane.x(), plane.y(), -1).normalized();
  const double tilt_deg = std::acos(std::min(1.0, std::abs(up.z()))) * 180 / std::numbers::pi;
  check(tilt_deg < kSteepest_deg, "[localise] the table is tilted by ", std::lround(tilt_deg),
        " degrees in the world; give the pose of the camera's optical frame (x right, y down, z forward) in a world "
        "with z up");
}

/// Throws Error if the object is a hole in the table: then the images are exchanged.
void check_order(const Foreground& foreground, const cv::Mat1b& object, const cv::Mat1f& before,
                 const cv::Mat1f& after) {
  constexpr float kRise_m = 0.002f;
  constexpr double kMeanFall_m = 0.0005;
  constexpr int kLeast_px = 8;
  cv::Mat1b around;
  cv::dilate(object, around, cv::getStructuringElement(cv::MORPH_ELLIPSE, {25, 25}));
  int rose = 0, fell = 0, measured = 0;
  double sum_m = 0;
  for (int y = 0; y < object.rows; ++y)
    for (int x = 0; x < object.cols; ++x) {
      if (around(y, x) == 0 || before(y, x) <= 0 || after(y, x) <= 0) continue;
      const float rise = foreground.rise_m(y, x);
      rose += rise > kRise_m, fell += rise < -kRise_m;
      if (object(y, x) != 0) ++measured, sum_m += static_cast<double>(rise);
    }
  check((fell < kLeast_px || fell <= rose) && (measured == 0 || sum_m / measured > -kMeanFall_m),
        "[localise] what is new lies below the table; are the images of the table and of the object exchanged? ", fell,
        " pixels are further from the camera than before, ", rose, " are nearer");
}

/// Throws Error unless a quarter of the object's pixels have a depth in both images, and half of its contour has one
/// within a pixel. Cameras measure none of black, shiny and transparent surfaces; the rest, such as the ground of a cup
/// or pixels of the table, would stand for the object.
void check_measured(const cv::Mat1b& object, const std::vector<std::vector<cv::Point>>& contours,
                    const cv::Mat1f& before, const cv::Mat1f& after) {
  constexpr double kShare = 0.25, kContourShare = 0.5;
  constexpr const char* kAdvice =
      " are needed; cameras measure none of black, shiny or transparent objects: cover it, or give its place and size";
  const int pixels = cv::countNonZero(object), needed = static_cast<int>(std::ceil(kShare * pixels));
  for (const auto& [depth, which] : {std::pair(&before, "background"), std::pair(&after, "current")}) {
    const int measured = cv::countNonZero(object & (*depth > 0));
    check(measured >= needed, "[localise] the ", which, " depth image has depth at ", measured, " of the object's ",
          pixels, " pixels, at least ", needed, kAdvice);
  }
  cv::Mat1b near;
  cv::dilate(object & (after > 0), near, cv::Mat1b::ones(3, 3));
  int length = 0, measured = 0;
  for (const auto& contour : contours)
    for (const cv::Point& p : contour) ++length, measured += near(p) != 0;
  const int needed_length = static_cast<int>(std::ceil(kContourShare * length));
  check(measured >= needed_length, "[localise] the current depth image has depth at ", measured, " of the ", length,
        " pixels of the object's contour, at least ", needed_length, kAdvice);
}

/// Throws Error for an object that is too large for a table: then depth is in another unit.
void check_size(const LocalisedObject& object, double unit_m, double distance_m) {
  constexpr double kLongest_m = 1.5, kNearest_m = 0.15, kFurthest_m = 5;
  const double longest_m = std::max(object.length_m, object.height_m);
  if (longest_m <= kLongest_m) return;
  std::string units;
  for (const DepthUnit& unit : kDepthUnits) {
    const double scale = unit.metres / (unit_m > 0 ? unit_m : 1);
    if (longest_m * scale > kLongest_m || distance_m * scale < kNearest_m || distance_m * scale > kFurthest_m) continue;
    units += joined(units.empty() ? "" : ", ", longest_m * scale, " m with depth in ", unit.name);
  }
  fail("[localise] the object is ", object.length_m, " x ", object.width_m, " x ", object.height_m,
       " m large, more than the ", kLongest_m, " m of anything on a table; is the unit of depth ",
       unit_m > 0 ? "(" + depth_unit_name(unit_m) + ") " : "", "wrong? It would be ",
       units.empty() ? "too large or too near in any" : units, "; see --depth-unit");
}

/// The pixels of the object. Parts less than about 16 pixels apart count as one object.
cv::Mat1b object_mask(const cv::Mat1b& foreground, bool take_largest) {
  constexpr int kLeast_px = 40;
  cv::Mat labels;
  cv::Mat1b joined;
  cv::dilate(foreground, joined, cv::getStructuringElement(cv::MORPH_ELLIPSE, {17, 17}));
  const int count = cv::connectedComponents(joined, labels, 8);
  std::vector<int> area(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < foreground.rows; ++y)
    for (int x = 0; x < foreground.cols; ++x)
      if (foreground(y, x) != 0) ++area[static_cast<std::size_t>(labels.at<int>(y, x))];
  const auto largest = std::max_element(area.begin() + 1, area.end());
  check(count > 1 && *largest >= kLeast_px,
        "[localise] nothing is found: the image does not differ from the background; check that the object is in view");
  const auto objects = std::count_if(area.begin() + 1, area.end(),
                                     [&](int pixels) { return pixels >= kLeast_px && pixels >= *largest / 12; });
  check(objects == 1 || take_largest, "[localise] there are ", objects,
        " objects; leave one on the table, or ask for the largest");
  return foreground & (labels == static_cast<int>(largest - area.begin()));
}

/// The depth of a pixel at the object's edge: the median of the measured pixels of the object around it; 0 if there is
/// none within 8 pixels.
float depth_near(const cv::Mat1f& depth, const cv::Mat1b& inside, const cv::Mat1b& whole, int y, int x) {
  std::vector<float> values;
  for (int reach = 2; values.empty() && reach <= 8; reach += 2) {
    const cv::Mat1b& object = reach == 2 ? inside : whole;
    for (int ny = std::max(0, y - reach); ny <= std::min(depth.rows - 1, y + reach); ++ny)
      for (int nx = std::max(0, x - reach); nx <= std::min(depth.cols - 1, x + reach); ++nx)
        if (object(ny, nx) != 0 && depth(ny, nx) > 0) values.push_back(depth(ny, nx));
  }
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double percentile(std::vector<double>& values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The height of the table under the object in the world, and of the object above the table.
struct Heights {
  double table_m, object_m;
};

Heights heights(const Intrinsics& camera, const Eigen::Isometry3d& camera_to_world, const cv::Mat1f& background,
                const cv::Mat1f& current, const cv::Mat1b& object) {
  const auto z_of = [&](int y, int x, float depth) {
    return (camera_to_world * deprojected_m(camera, x, y, depth)).z();
  };
  std::vector<double> table, top;
  for (int y = 1; y + 1 < object.rows; ++y)
    for (int x = 1; x + 1 < object.cols; ++x) {
      if (object(y, x) == 0) continue;
      if (background(y, x) > 0) table.push_back(z_of(y, x, background(y, x)));
      std::vector<double> around;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (object(y + dy, x + dx) != 0 && current(y + dy, x + dx) > 0)
            around.push_back(z_of(y + dy, x + dx, current(y + dy, x + dx)));
      if (around.size() >= 3) top.push_back(percentile(around, 0.5));
    }
  check(!table.empty() && !top.empty(), "[localise] the depth images have no measurements where the object is");
  const double table_m = percentile(table, 0.5);
  // Almost the highest pixel. The limit in pixels is for large objects, whose highest part may be small: a hook or the
  // end of a handle.
  constexpr double kShare = 0.008, kMost_px = 12;
  const double share = std::min(kShare, kMost_px / static_cast<double>(top.size()));
  const double height_m = percentile(top, 1 - share) - table_m;
  constexpr double kNoise_m = 0.005;
  check(height_m > -kNoise_m, "[localise] what is new lies ", -height_m,
        " m below the table; are the images of the table and of the object exchanged?");
  return {table_m, std::max(height_m, 0.0)};
}

/// Images of kLocaliseSteps.
std::vector<Image> images_of_steps(const Intrinsics& camera, const Eigen::Isometry3d& camera_to_world,
                                   const Foreground& foreground, const cv::Mat1b& object, const cv::Mat3b& after,
                                   const std::vector<std::vector<cv::Point>>& contours,
                                   const cv::RotatedRect& rectangle_mm, const LocalisedObject& found) {
  cv::Mat1b grey;
  foreground.difference.convertTo(grey, CV_8U, 8);
  cv::Mat3b drawn = after.clone();
  cv::drawContours(drawn, contours, -1, {255, 0, 0}, 1);
  const Eigen::Isometry3d world_to_camera = camera_to_world.inverse();
  const auto pixel_of = [&](double x_m, double y_m) {
    const Eigen::Vector2d pixel = projected_px(camera, world_to_camera * Eigen::Vector3d(x_m, y_m, found.centre_m.z()));
    return cv::Point(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  };
  cv::Point2f corners[4];
  rectangle_mm.points(corners);
  for (int i = 0; i < 4; ++i) {
    const auto corner = [&](int k) { return pixel_of(corners[k % 4].x / 1000.0, corners[k % 4].y / 1000.0); };
    cv::line(drawn, corner(i), corner(i + 1), {0, 255, 0}, 1);
  }
  cv::circle(drawn, pixel_of(found.centre_m.x(), found.centre_m.y()), 4, {0, 255, 255}, -1);
  cv::Mat1b raised;
  foreground.rise_m.convertTo(raised, CV_8U, 230 / std::max(found.height_m, 0.005), 12);
  return {image_of(grey), image_of(object), image_of(drawn), image_of(raised)};
}

/// What to say after an error if the table is further or nearer than any: "" otherwise.
std::string doubt_about_unit(double unit_m, double distance_m) {
  constexpr double kNearest_m = 0.15, kFurthest_m = 5;
  if (distance_m >= kNearest_m && distance_m <= kFurthest_m) return "";
  return joined("; the table is ", distance_m, " m below the camera: is the unit of depth ",
                unit_m > 0 ? "(" + depth_unit_name(unit_m) + ") " : "", "wrong? See --depth-unit");
}

/// Both images of a table, and the pose of the camera for them.
struct Images {
  const Intrinsics& camera;
  const Eigen::Isometry3d& camera_to_world;
  cv::Mat3b before, after;
  cv::Mat1f depth_before, depth_after;
};

LocalisedObject measured_object(const Images& images, const LocaliseOptions& options) {
  const auto& [camera, camera_to_world, before, after, depth_before, depth_after] = images;
  const Foreground foreground = find_foreground(before, depth_before, after, depth_after);
  const cv::Mat1b object = object_mask(foreground.mask, options.take_largest);

  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(object, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  check_measured(object, contours, depth_before, depth_after);
  check_order(foreground, object, depth_before, depth_after);
  check_horizontal(camera, camera_to_world, depth_before, object);
  std::vector<cv::Point2f> outline;  // in the world's xy plane, millimetres
  double pixel_mm = 0;
  cv::Mat1b inside;
  cv::erode(object, inside, cv::Mat1b::ones(3, 3));
  const Heights height = heights(camera, camera_to_world, depth_before, depth_after, object);
  for (const auto& contour : contours)
    for (const cv::Point& p : contour) {
      check(p.x > 0 && p.y > 0 && p.x + 1 < object.cols && p.y + 1 < object.rows,
            "[localise] the object is cut off by the border of the image; move it or the camera");
      const float depth = depth_near(depth_after, inside, object, p.y, p.x);
      if (depth <= 0) continue;
      const Eigen::Vector3d at = 1000 * (camera_to_world * deprojected_m(camera, p.x, p.y, depth));
      outline.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()));
      pixel_mm += 1000 * depth / std::sqrt(camera.fx * camera.fy);
    }
  check(outline.size() >= 3, "[localise] the depth image has no measurements along the object's contour");
  pixel_mm /= static_cast<double>(outline.size());
  const cv::RotatedRect rectangle = cv::minAreaRect(outline);
  constexpr double kSoftness_px = 0.3;  // error of a contour point, mostly from the size of the pixels
  const cv::Point2d middle = soft_enclosing_centre(outline, kSoftness_px * pixel_mm);

  LocalisedObject result;
  // The centres of contour pixels lie half a pixel inside the contour, and blur moves it outwards by a fifth of one.
  const double margin_mm = 0.6 * pixel_mm;
  const double a = (rectangle.size.width + margin_mm) / 1000, b = (rectangle.size.height + margin_mm) / 1000;
  result.length_m = std::max(a, b);
  result.width_m = std::min(a, b);
  result.height_m = height.object_m;
  result.yaw_rad = (rectangle.angle + (a >= b ? 0.0 : 90.0)) * std::numbers::pi / 180;
  result.yaw_rad -= std::numbers::pi * std::floor(result.yaw_rad / std::numbers::pi);
  result.centre_m = {middle.x / 1000.0, middle.y / 1000.0, height.table_m + height.object_m / 2};
  result.diagonal_m = std::sqrt(result.length_m * result.length_m + result.width_m * result.width_m +
                                result.height_m * result.height_m);
  if (options.keep_steps)
    result.steps = images_of_steps(camera, camera_to_world, foreground, object, after, contours, rectangle, result);
  return result;
}

}  // namespace

LocalisedObject locate(const Intrinsics& camera, const Eigen::Isometry3d& camera_to_world, const RgbdView& background,
                       const RgbdView& current, const LocaliseOptions& options) {
  const std::string problem = intrinsics_problem(camera);
  check(problem.empty(), "[localise] ", problem);
  // The looking direction's z. A pose of another frame of a camera above the table has 0 here, up to rounding, or more.
  const double looking_z = camera_to_world.linear()(2, 2);
  constexpr double kLeastDown = 0.1;
  const bool looks_down = -looking_z > kLeastDown;
  check(looks_down, "[localise] the camera looks ", looking_z > kLeastDown ? "upwards" : "sideways",
        "; give the pose of its optical frame (z forward) in a world with z up");
  check_fits(camera, background, "background");
  check_fits(camera, current, "current");
  const Images images{camera,
                      camera_to_world,
                      matrix_of(background.rgb),
                      matrix_of(current.rgb),
                      depth_of(background.depth),
                      depth_of(current.depth)};
  const double camera_m = camera_to_world.translation().z(), unit_m = background.depth.unit_m;
  const double table_m = common_height_m(camera, camera_to_world, images.depth_before).value_or(0);
  if (!options.unit_is_certain) check_unit(unit_m, camera_m, table_m);
  LocalisedObject result;
  try {
    result = measured_object(images, options);
  } catch (const Error& error) {
    fail(error.what(), doubt_about_unit(unit_m, camera_m - table_m));
  }
  check_size(result, unit_m, camera_m - table_m);
  return result;
}

}  // namespace svnet::localise
