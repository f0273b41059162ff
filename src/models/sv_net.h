#pragma once
#include <string>

#include "base/enum_names.h"
#include "nn/graph/graph.h"

namespace svnet::models {

/// How a camera pose (θ azimuth, φ elevation) becomes the input `angles` of the network.
///   radians    θ − π, φ − π
///   sphere     the unit vector towards the camera: cos φ cos θ, cos φ sin θ, sin φ
///   harmonics  4 · (√2 cos φ cos θ, √2 cos φ sin θ, √2 cos φ cos 2θ, √2 cos φ sin 2θ, (φ − 65°) / 15°). With 2θ the
///              network can easily give opposite views equal scores. The factor 4 keeps these few inputs from being
///              lost beside hundreds of activations.
enum class AngleEncoding { radians, sphere, harmonics };
constexpr auto enum_table(AngleEncoding) {
  return std::to_array<EnumName<AngleEncoding>>({{AngleEncoding::radians, "radians"},
                                                 {AngleEncoding::sphere, "sphere"},
                                                 {AngleEncoding::harmonics, "harmonics"}});
}
/// Throws Error for an unknown name.
AngleEncoding angle_encoding_named(const std::string& name);

/// Number of floats of an encoded pose.
Index angle_count(AngleEncoding);
inline constexpr Index kMostAngles = 5;  ///< the largest angle_count
/// Writes angle_count floats.
void encode_angles(AngleEncoding, double theta_deg, double phi_deg, float* encoded);

/// The least and the greatest value, over all poses of the half-sphere, of a sum of encoded angles with the weights
/// w[0], w[stride], …; for harmonics they may lie outside of these.
struct AngleRange {
  float low, high;
};
AngleRange linear_range(AngleEncoding, const float* w, Index stride);

struct SvNetOptions {
  Index features = 25088;
  Index width = 4096;
  double dropout = 0.75;
  AngleEncoding angles = AngleEncoding::radians;
};

/// The two MLPs of SV-net (Guérin et al., "Semantically Meaningful View Selection", IROS 2018): inputs `features`
/// (features) and `angles` (angle_count), output `score` (1) in (0, 1). There are dropout layers only if the rate
/// is not 0.
Graph sv_net(const SvNetOptions& options);

}  // namespace svnet::models
