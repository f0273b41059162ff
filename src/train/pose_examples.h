#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/index.h"

namespace svnet::train {

/// Examples that a head on pose inputs is fitted to: rows of inputs, what they should give, and where they belong.
struct PoseExamples {
  Index inputs = 0;
  std::vector<double> x{};               ///< (examples, inputs)
  std::vector<double> y{};               ///< (examples)
  std::vector<double> weight{};          ///< (examples) > 0: how much is known of y
  std::vector<std::int32_t> pose{};      ///< (examples) examples of a pose are neighbours
  std::vector<std::int32_t> category{};  ///< (examples)
  std::vector<std::uint8_t> top{};       ///< (examples) whether it is the top view; empty: not known
};

/// [begin, end) of the examples of one pose.
using PoseRange = std::pair<std::size_t, std::size_t>;

/// The ranges of equal neighbours in `poses`, in order. Requires that examples of a pose are neighbours.
inline std::vector<PoseRange> pose_ranges(std::span<const std::int32_t> poses) {
  std::vector<PoseRange> ranges;
  for (std::size_t begin = 0, end; begin < poses.size(); begin = end) {
    for (end = begin; end < poses.size() && poses[end] == poses[begin];) ++end;
    ranges.emplace_back(begin, end);
  }
  return ranges;
}

}  // namespace svnet::train
