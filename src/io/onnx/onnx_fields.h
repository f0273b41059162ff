#pragma once

// Numbers of fields in onnx.proto (github.com/onnx/onnx), of those that svnet writes.
namespace svnet::io::onnx {

enum ModelField {
  kIrVersion = 1,
  kProducerName = 2,
  kProducerVersion = 3,
  kGraph = 7,
  kOpsetImport = 8,
  kMetadata = 14
};
enum OpsetField { kOpsetVersion = 2 };
enum EntryField { kKey = 1, kValue = 2 };
enum GraphField { kNode = 1, kGraphName = 2, kInitializer = 5, kInput = 11, kOutput = 12 };
enum NodeField { kNodeInput = 1, kNodeOutput = 2, kNodeName = 3, kOpType = 4, kAttribute = 5 };
enum AttributeField { kAttributeName = 1, kFloat = 2, kInt = 3, kInts = 8, kAttributeType = 20 };
enum AttributeType { kTypeFloat = 1, kTypeInt = 2, kTypeInts = 7 };
enum TensorField { kDims = 1, kDataType = 2, kTensorName = 8, kRawData = 9 };
enum PortField { kPortName = 1, kPortType = 2 };
enum TypeField { kTensorType = 1 };
enum TensorTypeField { kElementType = 1, kShape = 2 };
enum ShapeField { kDimension = 1 };
enum DimensionField { kSize = 1, kSizeName = 2 };

}  // namespace svnet::io::onnx
