#include "models/backbone.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "models/sv_net.h"
#include "models/trained_graph.h"
#include "nn/graph/run.h"
#include "nn/numbers.h"
#include "nn/runtime/folding.h"

using namespace svnet;
using namespace svnet::models;
using test::relative_distance;

namespace {

/// Random parameters, so that batch norms change values; variances are positive.
Parameters drawn_parameters(const Graph& graph) {
  Parameters parameters = initial_parameters(graph, 5);
  std::uint64_t number = 0;
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters) {
      RandomStream random(9, Stream::weights, ++number);
      if (spec.shape.size() > 1) continue;
      Tensor value = parameters.at(node.parameter_name(spec));
      for (Index i = 0; i < value.size(); ++i)
        value.data<float>()[i] = static_cast<float>(
            spec.name == "beta" || spec.name == "moving_mean" || spec.name == "bias" ? 0.3 * random.normal()
                                                                                     : 0.5 + random.uniform());
    }
  return parameters;
}

Tensor images(Index count, Index size) {
  Tensor x = Tensor::empty({count, size, size, 3});
  RandomStream random(1, Stream::weights);
  for (Index i = 0; i < x.size(); ++i) x.data<float>()[i] = static_cast<float>(2 * random.uniform() - 1);
  return x;
}

}  // namespace

TEST_CASE("networks have as many parameters and features as Keras'") {
  CHECK(backbone_kind("vgg16").graph(224, false).parameter_count() == 14714688);
  CHECK(backbone_kind("vgg16").graph(224, true).parameter_count() == 138357544);
  CHECK(backbone_kind("vgg19").graph(224, false).parameter_count() == 20024384);
  CHECK(backbone_kind("vgg19").graph(224, true).parameter_count() == 143667240);
  CHECK(backbone_kind("xception").graph(299, false).parameter_count() == 20861480);
  CHECK(backbone_kind("xception").graph(299, true).parameter_count() == 22910480);
  CHECK(backbone_kind("mobilenet").graph(224, false).parameter_count() == 3228864);
  CHECK(backbone_kind("mobilenet").graph(224, true).parameter_count() == 4253864);
  CHECK(backbone_kind("mobilenet_v2").graph(224, false).parameter_count() == 2257984);
  CHECK(backbone_kind("mobilenet_v2").graph(224, true).parameter_count() == 3538984);
  CHECK(random_backbone("mobilenet", "", 1).dimension() == 1024);
  CHECK(random_backbone("mobilenet_v2", "avg_pool", 1).dimension() == 1280);
  CHECK(sv_net({}).parameter_count() == 153186309);
}

TEST_CASE("an unknown backbone or layer is named with its nearest neighbour") {
  CHECK_THROWS_WITH(backbone_kind("mobilenet_v3"), Catch::Contains("did you mean 'mobilenet_v2'?"));
  CHECK_THROWS_WITH(random_backbone("mobilenet", "conv_pw_5_rely", 1),
                    Catch::Contains("did you mean 'conv_pw_5_relu'?"));
}

TEST_CASE("folding batch norms and activations changes only rounding") {
  const Graph graph = backbone_kind("tiny_xception").graph(64, false);
  const Parameters parameters = drawn_parameters(graph);
  const Tensor x = images(2, 64);
  for (NodeId output = 1; output <= graph.output(); ++output) {
    const FoldedGraph fast = folded(graph, parameters, output);
    const Tensor actual = run_inference(fast.graph, fast.parameters, {x}, {fast.graph.output()})[0];
    INFO(graph.node(output).name);
    CHECK(relative_distance(actual, run_inference(graph, parameters, {x}, {output})[0]) <= 2e-5);
  }
  CHECK(folded(graph, parameters, graph.output()).graph.nodes().size() < graph.nodes().size() * 2 / 3);
}

TEST_CASE("compiled networks agree with plain operations, at every layer", "[slow]") {
  for (const auto& kind : backbone_kinds()) {
    // Every layer of the small networks, some of the large ones; the size leaves odd borders.
    const bool small = kind.name.starts_with("tiny"), separable = !kind.name.starts_with("vgg");
    const Index size = separable ? 75 : 46;
    const Graph graph = kind.graph(size, false);
    const Parameters parameters = drawn_parameters(graph);
    const Tensor x = images(2, size);
    for (NodeId output = 1; output <= graph.output(); output += small ? 1 : 7) {
      const Inference compiled(graph, parameters, output);
      const Tensor expected = run_inference(graph, parameters, {x}, {output})[0];
      const Tensor actual = compiled.run({x});
      INFO(kind.name << ", layer " << graph.node(output).name);
      REQUIRE(actual.shape() == expected.shape());
      CHECK(relative_distance(actual, expected) <= 2e-5);
    }
  }
}

TEST_CASE("angles are encoded as documented") {
  float encoded[kMostAngles];
  encode_angles(AngleEncoding::radians, 90, 45, encoded);
  CHECK(encoded[0] == Approx(-M_PI / 2));
  CHECK(encoded[1] == Approx(-3 * M_PI / 4));
  encode_angles(AngleEncoding::sphere, 90, 60, encoded);
  CHECK(encoded[0] == Approx(0).margin(1e-7));
  CHECK(encoded[1] == Approx(0.5));
  CHECK(encoded[2] == Approx(std::sqrt(3) / 2));
  encode_angles(AngleEncoding::harmonics, 90, 60, encoded);
  const double expected[] = {0, 2 * std::sqrt(2), -2 * std::sqrt(2), 0, -4.0 / 3};
  for (Index i = 0; i < angle_count(AngleEncoding::harmonics); ++i)
    CHECK(encoded[i] == Approx(expected[i]).margin(1e-6));
  float above[kMostAngles];
  encode_angles(AngleEncoding::harmonics, 90, 90, encoded);
  encode_angles(AngleEncoding::harmonics, 225, 90, above);
  for (Index i = 0; i < kMostAngles; ++i) CHECK(above[i] == Approx(encoded[i]).margin(1e-6));  // one and the same view
}

TEST_CASE("the range of a sum of angles holds its value at every pose") {
  for (const AngleEncoding encoding : {AngleEncoding::radians, AngleEncoding::sphere, AngleEncoding::harmonics}) {
    const bool exact = encoding != AngleEncoding::harmonics;
    for (const int signs : {0, 1, 2, 3, 4, 5, 6, 7, 21, 26}) {
      float w[2 * kMostAngles];
      for (int i = 0; i < kMostAngles; ++i)
        w[2 * i] = (0.3f + 0.1f * static_cast<float>(i)) * (signs >> i & 1 ? -1 : 1);
      const AngleRange range = linear_range(encoding, w, 2);
      double low = 1e9, high = -1e9;
      for (double theta = 0; theta <= 360; theta += 0.5)
        for (double phi = 0; phi <= 90; phi += 0.5) {
          float encoded[kMostAngles];
          encode_angles(encoding, theta, phi, encoded);
          double sum = 0;
          for (Index i = 0; i < angle_count(encoding); ++i) sum += static_cast<double>(w[2 * i]) * encoded[i];
          low = std::min(low, sum), high = std::max(high, sum);
        }
      CHECK(range.low <= low + 1e-5);
      CHECK(range.high >= high - 1e-5);
      if (exact) CHECK(range.low >= low - 1e-3);
      if (exact) CHECK(range.high <= high + 1e-3);
    }
  }
}

TEST_CASE("an encoding of angles is known by its name") {
  for (const AngleEncoding encoding : {AngleEncoding::radians, AngleEncoding::sphere, AngleEncoding::harmonics})
    CHECK(angle_encoding_named(name_of(encoding)) == encoding);
  CHECK_THROWS_WITH(angle_encoding_named("harmonic"),
                    "[sv_net] there is no angle encoding 'harmonic', did you mean 'harmonics'?");
}

TEST_CASE("the last block of every backbone has one input, the output of one layer") {
  const std::pair<const char*, const char*> first_layers[] = {
      {"vgg16", "block5_conv1"},   {"vgg19", "block5_conv1"},           {"xception", "block14_sepconv1"},
      {"mobilenet", "conv_dw_13"}, {"mobilenet_v2", "block_16_expand"}, {"tiny_xception", "block5_shortcut"}};
  REQUIRE(std::size(first_layers) == backbone_kinds().size());
  for (const auto& [name, first] : first_layers) {
    INFO(name);
    const BackboneKind& kind = backbone_kind(name);
    const Graph graph = kind.graph(kind.preprocessing.height, false);
    const NodeId output = output_layer(kind, graph, "");
    const Graph head = sv_net({.features = element_count(graph.node(output).shape), .width = 4});
    const Graph trained = trained_graph(graph, graph.find(kind.last_block_input), output, head);
    CHECK(trained.node(1).name == std::string("backbone/") + first);
    CHECK(trained.inputs().size() == 2);
    CHECK(trained.node(trained.inputs()[0]).shape == graph.node(graph.find(kind.last_block_input)).shape);
    CHECK(trained_graph(graph, 0, output, head).parameter_count() == graph.parameter_count() + head.parameter_count());
    CHECK(trained_graph(graph, output, output, head).parameter_count() == head.parameter_count());
  }
}

TEST_CASE("trained layers may not read layers below the last frozen one") {
  const Graph graph = backbone_kind("tiny_xception").graph(96, false);
  const Graph head = sv_net({.features = 256, .width = 4});
  CHECK_THROWS_WITH(trained_graph(graph, graph.find("block5_sepconv1"), graph.output(), head),
                    "[trained_graph] layer 'block5_shortcut' takes 'block4_act', which lies below 'block5_sepconv1'");
}

TEST_CASE("training changes copies of a backbone's parameters") {
  const BackboneKind& kind = backbone_kind("tiny_xception");
  const Graph graph = kind.graph(96, false), head = sv_net({.features = 256, .width = 4});
  Parameters backbone = initial_parameters(graph, 1), head_parameters;
  const Graph trained = trained_graph(graph, graph.find(kind.last_block_input), graph.output(), head);
  Parameters parameters = trained_parameters(trained, backbone, head, 2);
  const float before = backbone.at("block5_sepconv1_bn/gamma").data<float>()[0];
  parameters.at("backbone/block5_sepconv1_bn/gamma").data<float>()[0] = 7;
  CHECK(backbone.at("block5_sepconv1_bn/gamma").data<float>()[0] == before);
  take_trained(parameters, backbone, head_parameters);
  CHECK(backbone.at("block5_sepconv1_bn/gamma").data<float>()[0] == 7);
  CHECK(head_parameters.items().size() == initial_parameters(head, 2).items().size());
}
