#include "frame/seen_shapes.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "frame/turns.h"

namespace svnet::frame {

void shape_numbers(const FrameSpec& spec, std::span<const float> features, std::span<double> numbers) {
  check_feature_count(spec, features);
  std::size_t first = 0;
  if (has_axis(spec.frame)) {
    const TopFrame top = from_values(features.first<kTopFrameSize>());
    const ObjectShape shape = shape_of(top.axis, top.heights);
    for (const double number : {shape.elongation, shape.skew, shape.fill}) numbers[first++] = number;
    if (spec.depth == DepthChoice::heights)
      for (const double number : {shape.height, shape.slimness}) numbers[first++] = number;
    features = features.subspan(kTopFrameSize);
  }
  std::ranges::fill(numbers.subspan(first), 0.0);
  const auto components = static_cast<std::size_t>(spec.components);
  for (std::size_t i = 0; i < features.size(); ++i)
    numbers[first + i % components] += static_cast<double>(features[i]) / static_cast<double>(kTurns);
}

std::vector<double> shape_numbers(const FrameSpec& spec, std::span<const float> features) {
  std::vector<double> numbers(static_cast<std::size_t>(shape_number_count(spec)));
  shape_numbers(spec, features, numbers);
  return numbers;
}

Index shape_number_count(const FrameSpec& spec) {
  const Index of_axis = spec.depth == DepthChoice::heights ? 5 : 3;
  return (has_axis(spec.frame) ? of_axis : 0) + spec.components;
}

SeenShapes seen_shapes(const std::vector<std::vector<double>>& numbers) {
  check(!numbers.empty(), "[frame] there are no top views whose shapes a head could know");
  SeenShapes seen;
  for (std::size_t i = 0; i < numbers.front().size(); ++i) {
    double count = 0, sum = 0, squares = 0;
    for (const auto& view : numbers)
      if (std::isfinite(view[i])) count += 1, sum += view[i];
    const double mean = count > 1 ? sum / count : 0;
    for (const auto& view : numbers)
      if (std::isfinite(view[i])) squares += (view[i] - mean) * (view[i] - mean);
    seen.mean.push_back(mean);
    seen.deviation.push_back(count > 1 ? std::sqrt(squares / count) : 0);
  }
  for (const auto& view : numbers) seen.limit = std::max(seen.limit, distance(seen, view));
  return seen;
}

double distance(const SeenShapes& seen, std::span<const double> numbers) {
  double count = 0, squares = 0;
  for (std::size_t i = 0; i < seen.mean.size(); ++i) {
    if (!std::isfinite(numbers[i]) || seen.deviation[i] == 0) continue;
    const double deviations = (numbers[i] - seen.mean[i]) / seen.deviation[i];
    squares += deviations * deviations;
    count += 1;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

double trust(const SeenShapes& seen, std::span<const double> numbers) {
  const double far = distance(seen, numbers);
  return far <= seen.limit ? 1 : seen.limit / far;
}

}  // namespace svnet::frame
