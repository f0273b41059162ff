#include "io/onnx/onnx_reader.h"

#include <protozero/pbf_reader.hpp>

#include "base/error.h"
#include "io/onnx/onnx_fields.h"

namespace svnet::io {
namespace {

using namespace onnx;
using protozero::pbf_reader;

OnnxNode node_of(pbf_reader from) {
  OnnxNode node;
  while (from.next()) switch (from.tag()) {
      case kNodeInput:
        node.inputs.push_back(from.get_string());
        break;
      case kNodeOutput:
        node.name = from.get_string();
        break;
      case kOpType:
        node.op = from.get_string();
        break;
      case kAttribute: {
        pbf_reader attribute = from.get_message();
        std::string name;
        float number = 0;
        std::int64_t integer = 0, type = 0;
        std::vector<std::int64_t> integers;
        while (attribute.next()) switch (attribute.tag()) {
            case kAttributeName:
              name = attribute.get_string();
              break;
            case kFloat:
              number = attribute.get_float();
              break;
            case kInt:
              integer = attribute.get_int64();
              break;
            case kInts:
              integers.push_back(attribute.get_int64());
              break;
            case kAttributeType:
              type = attribute.get_enum();
              break;
            default:
              attribute.skip();
          }
        if (type == kTypeFloat)
          node.attributes.emplace_back(name, number);
        else if (type == kTypeInt)
          node.attributes.emplace_back(name, integer);
        else
          node.attributes.emplace_back(name, integers);
        break;
      }
      default:
        from.skip();
    }
  return node;
}

OnnxConstant constant_of(pbf_reader from) {
  OnnxConstant constant{};
  while (from.next()) switch (from.tag()) {
      case kDims:
        constant.shape.push_back(from.get_int64());
        break;
      case kDataType:
        constant.type = static_cast<OnnxType>(from.get_int32());
        break;
      case kTensorName:
        constant.name = from.get_string();
        break;
      case kRawData: {
        const auto view = from.get_view();
        const auto* bytes = reinterpret_cast<const std::byte*>(view.data());
        constant.bytes.assign(bytes, bytes + view.size());
        break;
      }
      default:
        from.skip();
    }
  return constant;
}

std::variant<Index, std::string> size_of(pbf_reader from) {
  std::variant<Index, std::string> size;
  while (from.next()) switch (from.tag()) {
      case kSize:
        size = static_cast<Index>(from.get_int64());
        break;
      case kSizeName:
        size = from.get_string();
        break;
      default:
        from.skip();
    }
  return size;
}

OnnxPort port_of(pbf_reader from) {
  OnnxPort port;
  while (from.next()) switch (from.tag()) {
      case kPortName:
        port.name = from.get_string();
        break;
      case kPortType: {
        pbf_reader type = from.get_message();
        while (type.next(kTensorType)) {
          pbf_reader tensor = type.get_message();
          while (tensor.next(kShape)) {
            pbf_reader shape = tensor.get_message();
            while (shape.next(kDimension)) port.shape.push_back(size_of(shape.get_message()));
          }
        }
        break;
      }
      default:
        from.skip();
    }
  return port;
}

OnnxGraph graph_of(pbf_reader from) {
  OnnxGraph graph;
  while (from.next()) switch (from.tag()) {
      case kNode:
        graph.nodes.push_back(node_of(from.get_message()));
        break;
      case kInitializer:
        graph.constants.push_back(constant_of(from.get_message()));
        break;
      case kInput:
        graph.inputs.push_back(port_of(from.get_message()));
        break;
      case kOutput:
        graph.outputs.push_back(port_of(from.get_message()));
        break;
      default:
        from.skip();
    }
  return graph;
}

}  // namespace

OnnxGraph parse_onnx(const std::string& name, std::string_view bytes, int* opset) {
  OnnxGraph graph;
  std::map<std::string, std::string> metadata;
  try {
    pbf_reader model(bytes.data(), bytes.size());
    while (model.next()) switch (model.tag()) {
        case kGraph:
          graph = graph_of(model.get_message());
          break;
        case kOpsetImport: {
          pbf_reader imported = model.get_message();
          while (imported.next(kOpsetVersion)) {
            const std::int64_t version = imported.get_int64();
            if (opset != nullptr) *opset = static_cast<int>(version);
          }
          break;
        }
        case kMetadata: {
          pbf_reader entry = model.get_message();
          std::string key, value;
          while (entry.next())
            if (entry.tag() == kKey)
              key = entry.get_string();
            else if (entry.tag() == kValue)
              value = entry.get_string();
            else
              entry.skip();
          metadata[key] = value;
          break;
        }
        default:
          model.skip();
      }
  } catch (const protozero::exception& error) {
    fail(name, ": is not an ONNX model: ", error.what());
  }
  check(!graph.nodes.empty() && !graph.outputs.empty(), name, ": is not an ONNX model: it has no graph");
  graph.metadata = std::move(metadata);
  return graph;
}

}  // namespace svnet::io
