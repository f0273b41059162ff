#include "frame/turns.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "frame/pose_inputs.h"
#include "frame/reduce.h"
#include "frame/turned_image.h"

namespace svnet::frame {
namespace {

constexpr int kTurnsOfAKind = kTurns / 2;  // as seen, and mirrored
constexpr double kStep_deg = 360.0 / kTurnsOfAKind, kFirst_deg = kStep_deg / 4;

/// Adds half of the interpolation at `theta_deg` between the turns first_deg + k kStep_deg: `place` is that of k = 0 in
/// turns().
void add_interpolation(double theta_deg, double first_deg, int place, std::array<double, kTurns>& weights) {
  const double steps = (theta_deg - first_deg) / kStep_deg, below = std::floor(steps), share = steps - below;
  const int k = (static_cast<int>(below) % kTurnsOfAKind + kTurnsOfAKind) % kTurnsOfAKind;
  const int near = 2 * k + place, far = 2 * ((k + 1) % kTurnsOfAKind) + place;
  weights[static_cast<std::size_t>(near)] += (1 - share) / 2;
  weights[static_cast<std::size_t>(far)] += share / 2;
}

}  // namespace

std::array<Turn, kTurns> turns() {
  std::array<Turn, kTurns> all;
  for (int i = 0; i < kTurns; ++i)
    all[static_cast<std::size_t>(i)] = {.theta_deg = kFirst_deg + i * kStep_deg / 2, .is_mirrored = i % 2 == 1};
  return all;
}

std::vector<Image> turned_images(const Image& top_image, Index side) {
  check(side > 0, "[frame] turned images are to have ", side, " pixels");
  const bool is_large = std::min(top_image.height, top_image.width) > side;
  const Image square = is_large ? reduced_image(top_image, side) : top_image;
  // A quarter turn later comes the image of the same kind, turned by a quarter: only the first ones are interpolated.
  constexpr int kOfAQuarter = kTurns / 4;
  const std::array<Turn, kTurns> all = turns();
  std::vector<Image> first(kOfAQuarter), images(kTurns);
  Parallel::shared().for_chunks(kOfAQuarter, 1, [&](Index i, Index, int) {
    first[static_cast<std::size_t>(i)] = turned_image(square, all[static_cast<std::size_t>(i)].theta_deg);
  });
  Parallel::shared().for_chunks(kTurns, 1, [&](Index i, Index, int) {
    const int quarters = static_cast<int>(4 - i / kOfAQuarter) % 4;
    Image turned = quarter_turned_square(first[static_cast<std::size_t>(i % kOfAQuarter)], quarters);
    const auto at = static_cast<std::size_t>(i);
    images[at] = all[at].is_mirrored ? mirrored(turned) : std::move(turned);
  });
  return images;
}

std::array<double, kTurns> turn_weights(const view::CameraPose& pose) {
  std::array<double, kTurns> weights{};
  if (is_top(pose)) {
    weights.fill(1.0 / kTurns);
    return weights;
  }
  add_interpolation(pose.theta_deg, kFirst_deg, 0, weights);
  add_interpolation(pose.theta_deg, kFirst_deg + kStep_deg / 2, 1, weights);
  return weights;
}

}  // namespace svnet::frame
