// Each operation of run_onnx on values by hand, from the definitions of ONNX (onnx.ai/onnx/operators), and what it
// refuses.
#include "io/onnx/onnx_run.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "base/error.h"

using namespace svnet;
using namespace svnet::io;

namespace {

using Attributes = std::vector<std::pair<std::string, OnnxAttribute>>;
using Integers = std::vector<std::int64_t>;
using Floats = std::vector<float>;
using Sizes = std::vector<Index>;

/// The value of one node "y" whose inputs are the tensors, and then the constants of int64.
OnnxTensor value_of(const std::string& op, const std::vector<OnnxTensor>& tensors, Attributes attributes = {},
                    const std::vector<Integers>& constants = {}) {
  OnnxGraph graph;
  std::map<std::string, OnnxTensor> inputs;
  std::vector<std::string> names;
  for (const OnnxTensor& tensor : tensors) {
    names.push_back(joined("x", inputs.size()));
    inputs[names.back()] = tensor;
  }
  for (const Integers& values : constants)
    names.push_back(graph.add_constant(joined("c", names.size()), {static_cast<Index>(values.size())}, values));
  graph.add(op, "y", names, std::move(attributes));
  graph.outputs.push_back({"y", {}});
  return run_onnx(graph, inputs);
}

/// The same for a constant of any type, and tensors after it.
OnnxTensor value_of_constant(const std::string& op, OnnxConstant constant, const std::vector<OnnxTensor>& tensors = {},
                             Attributes attributes = {}) {
  OnnxGraph graph;
  std::map<std::string, OnnxTensor> inputs;
  std::vector<std::string> names{constant.name};
  graph.constants.push_back(std::move(constant));
  for (const OnnxTensor& tensor : tensors) {
    names.push_back(joined("x", inputs.size()));
    inputs[names.back()] = tensor;
  }
  graph.add(op, "y", names, std::move(attributes));
  graph.outputs.push_back({"y", {}});
  return run_onnx(graph, inputs);
}

OnnxTensor row(Floats values) {
  const auto size = static_cast<Index>(values.size());
  return {{size}, std::move(values)};
}

/// 1, 2, 3, … in the shape.
OnnxTensor counted(Sizes shape) {
  OnnxTensor tensor = tensor_of(std::move(shape));
  float next = 1;
  for (float& value : tensor.values) value = next++;
  return tensor;
}

void check_equal(const OnnxTensor& y, const Sizes& shape, const Floats& values) {
  CHECK(y.shape == shape);
  REQUIRE(y.values.size() == values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    CAPTURE(i);
    CHECK(y.values[i] == Approx(values[i]).margin(1e-6));
  }
}

}  // namespace

TEST_CASE("ONNX operations on each element") {
  const OnnxTensor x = row({-2.5f, 0, 1.5f, 8});
  check_equal(value_of("Identity", {x}), {4}, x.values);
  check_equal(value_of("Relu", {x}), {4}, {0, 0, 1.5f, 8});
  check_equal(value_of("Floor", {x}), {4}, {-3, 0, 1, 8});
  check_equal(value_of("Sigmoid", {row({0, 100, -100})}), {3}, {0.5f, 1, 0});
  check_equal(value_of("Sin", {row({0, 1})}), {2}, {0, std::sin(1.0f)});
  check_equal(value_of("Cos", {row({0, 1})}), {2}, {1, std::cos(1.0f)});
  check_equal(value_of("Clip", {x, row({0}), row({6})}), {4}, {0, 0, 1.5f, 6});
  check_equal(value_of("HardSigmoid", {x}, {{"alpha", 0.25f}, {"beta", 0.5f}}), {4}, {0, 0.5f, 0.875f, 1});
  // Without the attribute, alpha and beta are 0 here: svnet always writes both.
  check_equal(value_of("HardSigmoid", {x}, {{"alpha", 0.25f}}), {4}, {0, 0, 0.375f, 1});
}

TEST_CASE("ONNX operations on two values repeat axes of size 1") {
  const OnnxTensor a = counted({2, 3});
  check_equal(value_of("Add", {a, a}), {2, 3}, {2, 4, 6, 8, 10, 12});
  check_equal(value_of("Sub", {a, row({1, 2, 3})}), {2, 3}, {0, 0, 0, 3, 3, 3});
  check_equal(value_of("Mul", {row({1, 10, 100}), a}), {2, 3}, {1, 20, 300, 4, 50, 600});
  check_equal(value_of("Add", {counted({2, 1}), counted({1, 3})}), {2, 3}, {2, 3, 4, 3, 4, 5});
  const std::string refusal = "[onnx] node 'y', Add: shapes do not fit";
  CHECK_THROWS_WITH(value_of("Add", {a, row({1, 2})}), refusal);
  CHECK_THROWS_WITH(value_of("Add", {a, counted({3, 3})}), refusal);
}

TEST_CASE("ONNX products of matrices") {
  check_equal(value_of("MatMul", {counted({2, 2}), counted({2, 3})}), {2, 3}, {9, 12, 15, 19, 26, 33});
  check_equal(value_of("MatMul", {row({1, 2}), counted({2, 1})}), {1}, {5});
  const std::string refusal = "[onnx] node 'y', MatMul: shapes do not fit";
  CHECK_THROWS_WITH(value_of("MatMul", {OnnxTensor{{}, {1}}, counted({1, 1})}), refusal);
  CHECK_THROWS_WITH(value_of("MatMul", {counted({2, 2}), row({1, 2})}), refusal);
  CHECK_THROWS_WITH(value_of("MatMul", {counted({2, 2}), counted({3, 2})}), refusal);
}

TEST_CASE("ONNX convolutions and pools") {
  const OnnxTensor image = counted({1, 1, 3, 3});
  const Attributes padded{{"pads", Integers{1, 1, 1, 1}}, {"strides", Integers{2, 2}}};
  check_equal(value_of("Conv", {image, tensor_of({1, 1, 2, 2}, 1)}), {1, 1, 2, 2}, {12, 16, 24, 28});
  check_equal(value_of("Conv", {image, tensor_of({1, 1, 3, 3}, 1), row({0.5f})}, padded), {1, 1, 2, 2},
              {12.5f, 16.5f, 24.5f, 28.5f});
  // Each channel by itself.
  check_equal(value_of("Conv", {counted({1, 2, 1, 2}), counted({2, 1, 1, 1})}, {{"group", std::int64_t{2}}}),
              {1, 2, 1, 2}, {1, 2, 6, 8});
  const Attributes two_by_two{{"kernel_shape", Integers{2, 2}}};
  check_equal(value_of("MaxPool", {image}, two_by_two), {1, 1, 2, 2}, {5, 6, 8, 9});
  check_equal(value_of("AveragePool", {image}, two_by_two), {1, 1, 2, 2}, {3, 4, 6, 7});
  // Zeros around the image do not count.
  Attributes with_pads = padded;
  with_pads.emplace_back("kernel_shape", Integers{2, 2});
  check_equal(value_of("AveragePool", {image}, with_pads), {1, 1, 2, 2}, {1, 2.5f, 5.5f, 7});
  check_equal(value_of("GlobalMaxPool", {counted({1, 2, 2, 1})}), {1, 2, 1, 1}, {2, 4});
  check_equal(value_of("GlobalAveragePool", {counted({1, 2, 2, 1})}), {1, 2, 1, 1}, {1.5f, 3.5f});

  for (const char* op : {"MaxPool", "AveragePool", "GlobalMaxPool", "GlobalAveragePool"})
    CHECK_THROWS_WITH(value_of(op, {counted({1, 3, 3})}),
                      "[onnx] node 'y', " + std::string(op) + ": the input is not (N, C, H, W)");
  CHECK_THROWS_WITH(value_of("Conv", {counted({3, 3}), tensor_of({1, 1, 2, 2})}),
                    "[onnx] node 'y', Conv: the input is not (N, C, H, W)");
  CHECK_THROWS_WITH(value_of("Conv", {image, tensor_of({1, 2, 2, 2})}), "[onnx] node 'y', Conv: channels do not fit");
}

TEST_CASE("ONNX norms, softmax and means") {
  const Floats scale{2, 1}, bias{0, 10}, mean{1, 3}, variance{4, 1};
  check_equal(value_of("BatchNormalization", {counted({1, 2, 1, 2}), row(scale), row(bias), row(mean), row(variance)},
                       {{"epsilon", 0.0f}}),
              {1, 2, 1, 2}, {0, 1, 10, 11});
  check_equal(value_of("Softmax", {OnnxTensor{{2, 2}, {0, std::log(3.0f), 1000, 1000}}}), {2, 2},
              {0.25f, 0.75f, 0.5f, 0.5f});
  check_equal(value_of("ReduceMean", {counted({2, 3})}, {{"axes", Integers{0}}}), {3}, {2.5f, 3.5f, 4.5f});
  for (const Integers& axes : {Integers{1}, Integers{0, 1}})
    CHECK_THROWS_WITH(value_of("ReduceMean", {counted({2, 3})}, {{"axes", axes}}),
                      "[onnx] node 'y', ReduceMean: only the first axis can be averaged");
}

TEST_CASE("ONNX operations that move values") {
  const OnnxTensor x = counted({2, 3});
  check_equal(value_of("Transpose", {x}, {{"perm", Integers{1, 0}}}), {3, 2}, {1, 4, 2, 5, 3, 6});
  CHECK_THROWS_WITH(value_of("Transpose", {x}, {{"perm", Integers{0, 1, 2}}}),
                    "[onnx] node 'y', Transpose: perm does not fit");
  CHECK_THROWS_WITH(value_of("Transpose", {x}), "[onnx] node 'y', Transpose: perm does not fit");
  check_equal(value_of("Flatten", {counted({2, 1, 3})}), {2, 3}, x.values);

  check_equal(value_of("Reshape", {x}, {}, {{3, 2}}), {3, 2}, x.values);
  check_equal(value_of("Reshape", {x}, {}, {{0, 1, -1}}), {2, 1, 3}, x.values);
  CHECK_THROWS_WITH(value_of("Reshape", {x}, {}, {{4, 2}}), "[onnx] node 'y', Reshape: the number of elements differs");
  CHECK_THROWS_WITH(value_of("Reshape", {x}, {}, {{4, -1}}),
                    "[onnx] node 'y', Reshape: the number of elements differs");

  check_equal(value_of("Concat", {x, counted({1, 3})}, {{"axis", std::int64_t{0}}}), {3, 3},
              {1, 2, 3, 4, 5, 6, 1, 2, 3});
  check_equal(value_of("Concat", {x, counted({2, 1})}, {{"axis", std::int64_t{-1}}}), {2, 4}, {1, 2, 3, 1, 4, 5, 6, 2});

  check_equal(value_of("Pad", {x}, {}, {{0, 1, 1, 2}}), {3, 6}, {0, 1, 2, 3, 0, 0, 0, 4, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK_THROWS_WITH(value_of("Pad", {x}, {}, {{0, 1, 1}}), "[onnx] node 'y', Pad: pads do not fit");

  const auto slice = [&](std::int64_t start, std::int64_t axis, std::int64_t step) {
    return value_of("Slice", {x}, {}, {{start}, {INT32_MIN}, {axis}, {step}});
  };
  check_equal(slice(-1, 1, -1), {2, 3}, {3, 2, 1, 6, 5, 4});
  check_equal(slice(-1, 0, -1), {2, 3}, {4, 5, 6, 1, 2, 3});
  const std::string refusal = "[onnx] node 'y', Slice: only whole axes can be reversed";
  CHECK_THROWS_WITH(slice(0, 1, -1), refusal);
  CHECK_THROWS_WITH(slice(-1, 1, 1), refusal);
}

TEST_CASE("ONNX constants of fewer bits") {
  const auto bytes = [](std::initializer_list<int> values) {
    std::vector<std::byte> result;
    for (const int value : values) result.push_back(static_cast<std::byte>(value));
    return result;
  };
  const OnnxConstant bf16{"c", OnnxType::bf16, {2}, bytes({0x80, 0x3f, 0x00, 0xc0})};
  check_equal(value_of_constant("Cast", bf16), {2}, {1, -2});
  const OnnxConstant int8{"c", OnnxType::i8, {2, 2}, bytes({1, 2, -3, 4})};
  check_equal(value_of_constant("DequantizeLinear", int8, {row({0.5f, 2})}), {2, 2}, {0.5f, 4, -1.5f, 8});
  check_equal(value_of_constant("DequantizeLinear", int8, {row({0.5f, 2})}, {{"axis", std::int64_t{0}}}), {2, 2},
              {0.5f, 1, -6, 8});
  CHECK_THROWS_WITH(value_of_constant("Cast", int8), "[onnx] node 'y', Cast: the input is not bfloat16");
  CHECK_THROWS_WITH(value_of_constant("DequantizeLinear", bf16, {row({1})}),
                    "[onnx] node 'y', DequantizeLinear: the input is not int8");
  CHECK_THROWS_WITH(value_of("Cast", {row({1})}), "[onnx] node 'y', Cast: input 0 is not a constant");
  CHECK_THROWS_WITH(value_of("Cast", {}), "[onnx] node 'y', Cast: input 0 is not a constant");
}

TEST_CASE("an ONNX node that cannot be computed is named with its reason") {
  CHECK_THROWS_WITH(value_of("Gelu", {row({1})}), "[onnx] node 'y', Gelu: the operation is not known here");
  CHECK_THROWS_WITH(value_of("Relu", {}), "[onnx] node 'y', Relu: input 0 is missing");
  CHECK_THROWS_WITH(value_of("Add", {row({1})}), "[onnx] node 'y', Add: input 1 is missing");
  CHECK_THROWS_WITH(value_of("Reshape", {row({1})}), "[onnx] node 'y', Reshape: input 1 is not a constant");
  OnnxGraph graph;
  const std::array<float, 1> size{1};
  graph.add("Reshape", "y", {"x", graph.add_constant("sizes", {1}, size)});
  graph.add("Relu", "z", {"nobody"});
  graph.outputs.push_back({"z", {}});
  CHECK_THROWS_WITH(run_onnx(graph, {{"x", row({1})}}), "[onnx] node 'y', Reshape: input 1 is not int64");
  graph.nodes.erase(graph.nodes.begin());
  CHECK_THROWS_WITH(run_onnx(graph, {{"x", row({1})}}), "[onnx] node 'z', Relu: input 0 is missing");
}

TEST_CASE("an ONNX value and a constant may be read by several nodes") {
  OnnxGraph graph;
  const std::array<float, 2> values{1, 2};
  const std::string constant = graph.add_constant("c", {2}, values);
  const std::string sum = graph.add("Add", "sum", {"x", constant});
  const std::string product = graph.add("Mul", "product", {sum, constant});
  graph.add("Sub", "y", {product, sum});
  graph.outputs.push_back({"y", {}});
  check_equal(run_onnx(graph, {{"x", row({10, 20})}}), {2}, {0, 22});
}
