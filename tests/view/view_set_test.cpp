#include "view/view_set.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet::view;

namespace {

std::vector<std::size_t> chosen(const std::vector<CameraPose>& poses, const std::vector<double>& scores,
                                std::size_t count, const ViewSetOptions& options = {}) {
  std::vector<std::size_t> result(count);
  std::vector<double> nearest;
  result.resize(choose_view_set(
      poses, [&](std::size_t i) { return scores[i]; }, options, result, nearest));
  return result;
}

using Indices = std::vector<std::size_t>;

}  // namespace

TEST_CASE("a second view is far from the first one unless it is much worse") {
  const std::vector<CameraPose> poses{{0, 45}, {10, 45}, {180, 45}, {90, 45}};
  CHECK(chosen(poses, {1, 0.9, 0.8, 0.1}, 2) == Indices{0, 2});
  CHECK(chosen(poses, {1, 0.99, 0.2, 0.1}, 2) == Indices{0, 1});
  CHECK(chosen(poses, {1, 0.9, 0.8, 0.1}, 2, {.spread = 0}) == Indices{0, 1});
}

TEST_CASE("a pose that is too near to a chosen one is not chosen, even if no other is left") {
  const std::vector<CameraPose> poses{{0, 45}, {10, 45}, {20, 45}};
  CHECK(chosen(poses, {1, 0.9, 0.8}, 3, {.min_angle_deg = 10}) == Indices{0, 2});
  CHECK(chosen(poses, {1, 0.9, 0.8}, 3, {.min_angle_deg = 90}) == Indices{0});
}

TEST_CASE("poses without a score are not chosen") {
  const std::vector<CameraPose> poses{{0, 45}, {90, 45}, {180, 45}};
  const double nan = std::nan("");
  CHECK(chosen(poses, {nan, 0.5, 0.5}, 3) == Indices{1, 2});
  CHECK(chosen(poses, {nan, nan, nan}, 2).empty());
  CHECK(chosen({}, {}, 2).empty());
}
