#include "models/turned_backbone.h"

#include <catch2/catch.hpp>

#include "nn/graph/run.h"

using namespace svnet;
using namespace svnet::models;

namespace {

Graph input_of(const Shape& shape) {
  Graph graph;
  graph.input("image", shape);
  return graph;
}

Shape pooled_shape(const Shape& shape) {
  const Graph graph = pooled_graph(input_of(shape));
  return graph.node(graph.output()).shape;
}

}  // namespace

TEST_CASE("images of 7 x 7 are averaged over rows and columns 0-2, 2-4 and 4-6") {
  const Graph graph = pooled_graph(input_of({7, 7, 2}));
  Tensor image = Tensor::empty({1, 7, 7, 2});
  for (Index row = 0; row < 7; ++row)
    for (Index column = 0; column < 7; ++column) {
      image.data<float>()[(row * 7 + column) * 2] = static_cast<float>(row);
      image.data<float>()[(row * 7 + column) * 2 + 1] = static_cast<float>(column * column);
    }
  const Tensor pooled = run_inference(graph, {}, {image}, {graph.output()})[0];
  REQUIRE(pooled.shape() == Shape{1, 18});
  const double squares[] = {5.0 / 3, 29.0 / 3, 77.0 / 3};
  for (Index row = 0; row < 3; ++row)
    for (Index column = 0; column < 3; ++column) {
      CHECK(pooled.data<float>()[(row * 3 + column) * 2] == Approx(2 * row + 1));
      CHECK(pooled.data<float>()[(row * 3 + column) * 2 + 1] == Approx(squares[column]));
    }
}

TEST_CASE("windows cover images of any size, small and pooled ones are taken as they are") {
  for (const Index side : {3, 4, 5, 6, 8, 10, 14, 28}) {
    const Index wide = side + 1;
    CAPTURE(side);
    CHECK(pooled_shape({side, wide, 4}) == Shape{36});
    const Graph graph = pooled_graph(input_of({side, wide, 4}));
    const auto& window = graph.node(graph.find("places")).as<Pool2dLayer>()->window;
    CHECK(2 * window.stride_h + window.kh == side);
    CHECK(2 * window.stride_w + window.kw == wide);
    CHECK(window.kh >= window.stride_h);
  }
  CHECK(pooled_shape({2, 7, 4}) == Shape{56});
  CHECK(pooled_shape({1, 1, 4}) == Shape{4});
  CHECK(pooled_shape({5}) == Shape{5});
}

TEST_CASE("the projection has the same parameters at the end of a backbone and alone") {
  const Graph whole = projected_graph(pooled_graph(input_of({7, 7, 2})), 3), alone = projection_graph(18, 3);
  CHECK(whole.node(whole.output()).shape == Shape{3});
  const Parameters parameters = initial_parameters(whole, 1), others = initial_parameters(alone, 1);
  REQUIRE(parameters.items().size() == others.items().size());
  for (const auto& [name, value] : parameters.items()) CHECK(others.at(name).shape() == value.shape());
}
