#include "models/sv_net.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "base/text.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

constexpr double kHarmonicStrength = 4;

NodeId dropout(Graph& g, const std::string& name, NodeId x, double rate) {
  return rate > 0 ? g.add(name, DropoutLayer{rate}, {x}) : x;
}

/// Dense layer, batch norm, ReLU, named prefix_fc, prefix_bn, prefix_relu.
NodeId dense_block(Graph& g, const std::string& prefix, NodeId x, Index units) {
  x = g.add(prefix + "_fc", DenseLayer{.units = units}, {x});
  x = models::batch_norm(g, prefix + "_bn", x);
  return models::activation(g, prefix + "_relu", x, Activation::relu);
}

}  // namespace

AngleEncoding angle_encoding_named(const std::string& text) {
  const auto found = find_enum<AngleEncoding>(text);
  check(found.has_value(), "[sv_net] there is no angle encoding '", text, "'",
        suggestion(text, names_of<AngleEncoding>()));
  return *found;
}

Index angle_count(AngleEncoding encoding) {
  switch (encoding) {
    case AngleEncoding::radians:
      return 2;
    case AngleEncoding::sphere:
      return 3;
    case AngleEncoding::harmonics:
      return 5;
  }
  return kMostAngles;
}

void encode_angles(AngleEncoding encoding, double theta_deg, double phi_deg, float* encoded) {
  const double theta = theta_deg * std::numbers::pi / 180, phi = phi_deg * std::numbers::pi / 180;
  const auto write = [&](std::initializer_list<double> values) {
    std::transform(values.begin(), values.end(), encoded, [](double value) { return static_cast<float>(value); });
  };
  switch (encoding) {
    case AngleEncoding::radians:
      return write({theta - std::numbers::pi, phi - std::numbers::pi});
    case AngleEncoding::sphere:
      return write({std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi)});
    case AngleEncoding::harmonics: {
      const double level = kHarmonicStrength * std::numbers::sqrt2 * std::cos(phi);
      return write({level * std::cos(theta), level * std::sin(theta), level * std::cos(2 * theta),
                    level * std::sin(2 * theta), kHarmonicStrength * (phi_deg - 65) / 15});
    }
  }
}

AngleRange linear_range(AngleEncoding encoding, const float* w, Index stride) {
  constexpr double kPi = std::numbers::pi;
  double low = 0, high = 0;
  const auto weight = [&](Index i) { return static_cast<double>(w[i * stride]); };
  const auto add = [&](Index i, double from, double to) {  // an angle in [from, to]
    low += std::min(weight(i) * from, weight(i) * to);
    high += std::max(weight(i) * from, weight(i) * to);
  };
  switch (encoding) {
    case AngleEncoding::radians:
      add(0, -kPi, kPi);
      add(1, -kPi, -kPi / 2);
      break;
    case AngleEncoding::sphere: {
      const double level = std::hypot(weight(0), weight(1)), up = weight(2);
      low = up < 0 ? -std::hypot(level, up) : -level;
      high = up > 0 ? std::hypot(level, up) : level;
      break;
    }
    case AngleEncoding::harmonics: {
      const double level = kHarmonicStrength * std::numbers::sqrt2 *
                           (std::hypot(weight(0), weight(1)) + std::hypot(weight(2), weight(3)));
      add(4, kHarmonicStrength * (0 - 65.0) / 15, kHarmonicStrength * (90 - 65.0) / 15);
      low -= level;
      high += level;
      break;
    }
  }
  return {static_cast<float>(low), static_cast<float>(high)};
}

Graph sv_net(const SvNetOptions& o) {
  Graph g;
  NodeId x = g.input("features", {o.features});
  const NodeId angles = g.input("angles", {angle_count(o.angles)});
  x = dense_block(g, "mlp1_1", x, o.width);
  x = dropout(g, "mlp1_2_drop", x, o.dropout);
  x = dense_block(g, "mlp1_2", x, o.width);
  x = g.add("concat", ConcatLayer{}, {x, angles});
  x = dropout(g, "mlp2_1_drop", x, o.dropout);
  x = dense_block(g, "mlp2_1", x, o.width);
  x = dropout(g, "mlp2_2_drop", x, o.dropout);
  x = dense_block(g, "mlp2_2", x, o.width);
  x = dropout(g, "mlp2_3_drop", x, o.dropout);
  x = g.add("mlp2_3_fc", DenseLayer{.units = 1}, {x});
  x = models::batch_norm(g, "mlp2_3_bn", x);
  models::activation(g, "score", x, Activation::sigmoid);
  return g;
}

}  // namespace svnet::models
