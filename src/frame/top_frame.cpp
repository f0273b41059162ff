#include "frame/top_frame.h"

#include <cmath>

#include "base/error.h"
#include "frame/silhouette.h"

namespace svnet::frame {

TopFrame top_frame(const Image& top_image, const DepthImage* depth) {
  const Silhouette silhouette = depth != nullptr ? silhouette_of(*depth) : silhouette_of(top_image);
  TopFrame frame{axis_of(silhouette), {}};
  if (depth != nullptr) frame.heights = heights_of(*depth, silhouette, frame.axis);
  return frame;
}

TopFrameValues to_values(const TopFrame& frame) {
  const ObjectAxis& a = frame.axis;
  const Heights& h = frame.heights;
  const double values[] = {static_cast<double>(a.kind),
                           a.direction_deg,
                           a.elongation,
                           a.skew,
                           a.fill,
                           a.length,
                           a.width,
                           h.are_known ? 1.0 : 0.0,
                           h.measured,
                           h.height,
                           h.width,
                           h.mean_height,
                           h.flatness,
                           h.footprint,
                           h.volume};
  TopFrameValues floats{};
  static_assert(std::size(values) == kTopFrameSize);
  for (std::size_t i = 0; i < kTopFrameSize; ++i) floats[i] = static_cast<float>(values[i]);
  return floats;
}

TopFrame from_values(std::span<const float, kTopFrameSize> v) {
  for (std::size_t i = 0; i < kTopFrameSize; ++i)
    check(std::isfinite(v[i]), "[frame] value ", i, " of a top view is ", v[i], ", not a finite number");
  check(v[0] == 0 || v[0] == 1 || v[0] == 2, "[frame] value 0 of a top view is ", v[0], ", expected 0, 1 or 2");
  check(v[7] == 0 || v[7] == 1, "[frame] value 7 of a top view is ", v[7], ", expected 0 or 1");
  return {{.kind = static_cast<AxisKind>(static_cast<int>(v[0])),
           .direction_deg = v[1],
           .elongation = v[2],
           .skew = v[3],
           .fill = v[4],
           .length = v[5],
           .width = v[6]},
          {.are_known = v[7] == 1,
           .measured = v[8],
           .height = v[9],
           .width = v[10],
           .mean_height = v[11],
           .flatness = v[12],
           .footprint = v[13],
           .volume = v[14]}};
}

Index pose_input_count(const PoseInputOptions& options) {
  return static_cast<Index>(pose_input_groups(options).size());
}

}  // namespace svnet::frame
