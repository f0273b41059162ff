#include "io/onnx/onnx_graph.h"

#include <limits>
#include <protozero/pbf_writer.hpp>

#include "base/error.h"
#include "base/version.h"
#include "io/onnx/onnx_fields.h"

namespace svnet::io {
namespace {

using protozero::pbf_writer;

using namespace onnx;

/// Protocol buffers have lengths of 31 bits.
constexpr std::size_t kLargestModel = std::numeric_limits<std::int32_t>::max();

void write_attribute(pbf_writer& node, const std::string& name, const OnnxAttribute& value) {
  pbf_writer attribute(node, kAttribute);
  attribute.add_string(kAttributeName, name);
  if (const auto* number = std::get_if<float>(&value)) {
    attribute.add_float(kFloat, *number);
    attribute.add_enum(kAttributeType, kTypeFloat);
  } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    attribute.add_int64(kInt, *integer);
    attribute.add_enum(kAttributeType, kTypeInt);
  } else {
    for (const std::int64_t one : std::get<std::vector<std::int64_t>>(value)) attribute.add_int64(kInts, one);
    attribute.add_enum(kAttributeType, kTypeInts);
  }
}

void write_node(pbf_writer& graph, const OnnxNode& from) {
  pbf_writer node(graph, kNode);
  for (const std::string& input : from.inputs) node.add_string(kNodeInput, input);
  node.add_string(kNodeOutput, from.name);
  node.add_string(kNodeName, from.name);
  node.add_string(kOpType, from.op);
  for (const auto& [name, value] : from.attributes) write_attribute(node, name, value);
}

void write_constant(pbf_writer& graph, const OnnxConstant& from) {
  pbf_writer tensor(graph, kInitializer);
  for (const Index size : from.shape) tensor.add_int64(kDims, size);
  tensor.add_int32(kDataType, static_cast<std::int32_t>(from.type));
  tensor.add_string(kTensorName, from.name);
  tensor.add_bytes(kRawData, reinterpret_cast<const char*>(from.bytes.data()), from.bytes.size());
}

void write_port(pbf_writer& graph, GraphField field, const OnnxPort& from) {
  pbf_writer port(graph, field);
  port.add_string(kPortName, from.name);
  pbf_writer type(port, kPortType);
  pbf_writer tensor(type, kTensorType);
  tensor.add_int32(kElementType, static_cast<std::int32_t>(OnnxType::f32));
  pbf_writer shape(tensor, kShape);
  for (const auto& size : from.shape) {
    pbf_writer dimension(shape, kDimension);
    if (const auto* name = std::get_if<std::string>(&size))
      dimension.add_string(kSizeName, *name);
    else
      dimension.add_int64(kSize, std::get<Index>(size));
  }
}

template <class T>
std::vector<std::byte> bytes_of(std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string OnnxGraph::add(std::string op, std::string name, std::vector<std::string> from,
                           std::vector<std::pair<std::string, OnnxAttribute>> attributes) {
  nodes.push_back({std::move(op), std::move(name), std::move(from), std::move(attributes)});
  return nodes.back().name;
}

std::string OnnxGraph::add_constant(std::string name, std::vector<Index> shape, std::span<const float> values) {
  constants.push_back({std::move(name), OnnxType::f32, std::move(shape), bytes_of(values)});
  return constants.back().name;
}

std::string OnnxGraph::add_constant(std::string name, std::vector<Index> shape, std::span<const std::int64_t> values) {
  constants.push_back({std::move(name), OnnxType::i64, std::move(shape), bytes_of(values)});
  return constants.back().name;
}

std::string onnx_bytes(const std::string& name, const OnnxGraph& graph, int opset) {
  check(opset >= kLeastOnnxOpset && opset <= kMostOnnxOpset, name, ": ONNX opset ", opset, " is not one of ",
        kLeastOnnxOpset, " to ", kMostOnnxOpset);
  std::size_t constant_bytes = 0;
  for (const OnnxConstant& constant : graph.constants) constant_bytes += constant.bytes.size();
  check(constant_bytes < kLargestModel, name, ": the weights take ", constant_bytes,
        " bytes, an ONNX file holds at most 2 GiB; export with --precision int8 or bf16, or the parts by --part");
  std::string bytes;
  bytes.reserve(constant_bytes + constant_bytes / 64 + (std::size_t{1} << 20));
  pbf_writer model(bytes);
  model.add_int64(kIrVersion, opset < 15 ? 7 : 8);  // those of the releases in which the opsets appeared
  model.add_string(kProducerName, "svnet");
  model.add_string(kProducerVersion, kVersion);
  {
    pbf_writer imported(model, kOpsetImport);
    imported.add_int64(kOpsetVersion, opset);
  }
  for (const auto& [key, value] : graph.metadata) {
    pbf_writer entry(model, kMetadata);
    entry.add_string(kKey, key);
    entry.add_string(kValue, value);
  }
  {
    pbf_writer to(model, kGraph);
    to.add_string(kGraphName, "svnet");
    for (const OnnxNode& node : graph.nodes) write_node(to, node);
    for (const OnnxConstant& constant : graph.constants) write_constant(to, constant);
    for (const OnnxPort& port : graph.inputs) write_port(to, kInput, port);
    for (const OnnxPort& port : graph.outputs) write_port(to, kOutput, port);
  }
  check(bytes.size() <= kLargestModel, name, ": the model takes ", bytes.size(), " bytes, an ONNX file holds 2 GiB");
  return bytes;
}

}  // namespace svnet::io
