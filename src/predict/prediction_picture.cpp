#include "predict/prediction_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "frame/object_axis.h"
#include "frame/silhouette.h"
#include "image/contact_sheet.h"
#include "image/opencv_image.h"
#include "predict/half_sphere_plot.h"
#include "predict/predictor.h"
#include "view/colour_scale.h"

namespace svnet::predict {
namespace {

constexpr int kHeight_px = 624, kWidth_px = 1232, kSide_px = 512, kTop_px = 56, kLeft_px = 24, kPlotLeft_px = 568,
              kScaleLeft_px = 1120, kScaleWidth_px = 20, kChosenLeft_px = kWidth_px, kWideWidth_px = kWidth_px + 536;
constexpr double kRim_px = 232, kRadians = std::numbers::pi / 180;  // of HalfSphereCanvas
const cv::Scalar kText(30, 30, 30), kMuted(100, 100, 100), kAxis(214, 39, 40), kHalo(255, 255, 255);

enum class Align { left, centre };

void write(cv::Mat3b& picture, const std::string& text, cv::Point place, const cv::Scalar& colour = kText,
           double size = 0.5, Align align = Align::left) {
  if (align == Align::centre) place.x -= cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, nullptr).width / 2;
  cv::putText(picture, text, place, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// The centred square of the image.
Image square_of(const Image& top) {
  const Index side = std::min(top.height, top.width), above = (top.height - side) / 2, left = (top.width - side) / 2;
  Image square{side, side, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * side * side))};
  cv::Mat3b to = matrix_of(square);
  matrix_of(top)(
      cv::Rect(static_cast<int>(left), static_cast<int>(above), static_cast<int>(side), static_cast<int>(side)))
      .copyTo(to);
  return square;
}

/// Where an azimuth points in a top view: 0 to the left, 90 down (docs/camera-convention.md).
cv::Point2d direction(double theta_deg) { return {-std::cos(theta_deg * kRadians), std::sin(theta_deg * kRadians)}; }

void draw_axis(cv::Mat3b& picture, const frame::ObjectAxis& axis, const frame::Silhouette& silhouette) {
  double x = 0, y = 0, cells = 0;
  for (Index row = 0; row < frame::kSide; ++row)
    for (Index column = 0; column < frame::kSide; ++column)
      if (silhouette.inside[static_cast<std::size_t>(row * frame::kSide + column)] != 0) {
        x += static_cast<double>(frame::half_cells(column));
        y += static_cast<double>(frame::half_cells(row));
        cells += 1;
      }
  const double pixels_per_half_cell = kSide_px / (2.0 * frame::kSide);
  const cv::Point2d middle(kLeft_px + kSide_px / 2.0 + x / cells * pixels_per_half_cell,
                           kTop_px + kSide_px / 2.0 + y / cells * pixels_per_half_cell);
  const cv::Point2d along = direction(axis.direction_deg);
  const double half = 0.5 * axis.length * kSide_px;
  for (const auto& [colour, width] : {std::pair{kHalo, 5}, {kAxis, 2}})
    cv::arrowedLine(picture, middle - half * along, middle + half * along, colour, width, cv::LINE_AA, 0, 0.06);
}

void draw_top_image(cv::Mat3b& picture, const Image& top, const DepthImage* depth) {
  const Image square = resized_to_fit(square_of(top), kSide_px);
  matrix_of(square).copyTo(picture(cv::Rect(kLeft_px, kTop_px, kSide_px, kSide_px)));
  const frame::Silhouette silhouette = depth != nullptr ? frame::silhouette_of(*depth) : frame::silhouette_of(top);
  const frame::ObjectAxis axis = frame::axis_of(silhouette);
  std::string title = "the top image; ";
  switch (axis.kind) {
    case frame::AxisKind::found:
      title += "axis at azimuth " + fixed(axis.direction_deg, 0);
      draw_axis(picture, axis, silhouette);
      break;
    case frame::AxisKind::round:
      title += "round: no axis";
      break;
    case frame::AxisKind::unclear:
      title += "no axis: the object is not clear";
      break;
  }
  write(picture, title, {kLeft_px, kTop_px - 14});
}

void draw_labels(cv::Mat3b& picture) {
  const cv::Point2d centre(kPlotLeft_px + kSide_px / 2.0, kTop_px + kSide_px / 2.0);
  for (int theta_deg = 0; theta_deg < 360; theta_deg += 90)
    write(picture, std::to_string(theta_deg), centre + (kRim_px + 16) * direction(theta_deg) + cv::Point2d(0, 5), kText,
          0.45, Align::centre);
  // Between the spokes at 135 and 180 degrees.
  for (int phi_deg = 15; phi_deg < 90; phi_deg += 15)
    write(picture, std::to_string(phi_deg),
          centre + kRim_px * (90 - phi_deg) / 90 * direction(157.5) + cv::Point2d(0, 4), kMuted, 0.38, Align::centre);
}

void draw_scale(cv::Mat3b& picture, double lowest, double highest) {
  constexpr int kFrom_px = kTop_px + 40, kTo_px = kTop_px + kSide_px - 40;
  for (int y = kFrom_px; y < kTo_px; ++y) {
    const view::Colour colour = view::scale_colour(static_cast<double>(kTo_px - 1 - y) / (kTo_px - 1 - kFrom_px));
    cv::rectangle(picture, cv::Rect(kScaleLeft_px, y, kScaleWidth_px, 1), {colour[0], colour[1], colour[2]},
                  cv::FILLED);
  }
  for (const double share : {0.0, 0.5, 1.0})
    write(picture, fixed(lowest + share * (highest - lowest), 3),
          {kScaleLeft_px + kScaleWidth_px + 8, static_cast<int>(kTo_px - share * (kTo_px - kFrom_px)) + 5}, kText,
          0.45);
  write(picture, "score", {kScaleLeft_px, kFrom_px - 14}, kText, 0.45);
}

std::string pose_text(const view::CameraPose& pose) {
  return "theta " + fixed(pose.theta_deg, 1) + ", phi " + fixed(pose.phi_deg, 1);
}

}  // namespace

Image prediction_picture(const Image& top, const DepthImage* depth, std::span<const view::CameraPose> poses,
                         std::span<const float> scores, const Image* chosen) {
  check(top.height > 0 && top.width > 0, "[plot] the top image has no pixels");
  const Image plot = half_sphere_plot(poses, scores);
  const int width_px = chosen != nullptr ? kWideWidth_px : kWidth_px;
  Image result{kHeight_px, width_px,
               std::vector<std::uint8_t>(static_cast<std::size_t>(3 * kHeight_px * width_px), 255)};
  cv::Mat3b picture = matrix_of(result);
  draw_top_image(picture, top, depth);
  cv::Mat3b place = picture(cv::Rect(kPlotLeft_px, kTop_px, kSide_px, kSide_px));
  cv::rotate(matrix_of(plot), place, cv::ROTATE_180);
  write(picture, "predicted score by azimuth (around) and elevation (from the rim)", {kPlotLeft_px, kTop_px - 14});
  draw_labels(picture);
  const auto [lowest, highest] = std::minmax_element(scores.begin(), scores.end());
  draw_scale(picture, static_cast<double>(*lowest), static_cast<double>(*highest));

  const std::size_t best = best_view(scores);
  std::string caption = "Best of " + std::to_string(poses.size()) + " (red ring): " + pose_text(poses[best]) +
                        ", score " + fixed(scores[best], 3);
  const auto is_top = [](const view::CameraPose& pose) { return pose.phi_deg >= 89.5; };
  if (const auto found = std::ranges::find_if(poses, is_top); found != poses.end())
    caption += ". The top view has " + fixed(scores[static_cast<std::size_t>(found - poses.begin())], 3) + ".";
  write(picture, caption, {kLeft_px, kHeight_px - 22}, kText, 0.55);
  if (chosen != nullptr) {
    write(picture, "the view from there", {kChosenLeft_px, kTop_px - 14});
    const Image view = resized_to_fit(*chosen, kSide_px);
    matrix_of(view).copyTo(
        picture(cv::Rect(kChosenLeft_px, kTop_px, static_cast<int>(view.width), static_cast<int>(view.height))));
  }
  return result;
}

}  // namespace svnet::predict
