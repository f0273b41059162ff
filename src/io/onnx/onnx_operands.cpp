#include "io/onnx/onnx_operands.h"

#include <cstring>
#include <utility>
#include <variant>

#include "base/error.h"

namespace svnet::io {
namespace {

template <class T>
T attribute(const OnnxNode& node, const char* name, T value) {
  for (const auto& [known, given] : node.attributes)
    if (known == name) return std::get<T>(given);
  return value;
}

}  // namespace

OnnxOperands::OnnxOperands(const OnnxNode& node, std::map<std::string, const OnnxTensor*> tensors,
                           const std::map<std::string, const OnnxConstant*>& constants)
    : node_(node), tensors_(std::move(tensors)), constants_(constants) {}

const OnnxTensor& OnnxOperands::x(std::size_t i) const {
  const auto found = i < count() ? tensors_.find(node_.inputs[i]) : tensors_.end();
  if (found == tensors_.end()) refuse(joined("input ", i, " is missing"));
  return *found->second;
}

const OnnxConstant& OnnxOperands::constant(std::size_t i) const {
  const auto found = i < count() ? constants_.find(node_.inputs[i]) : constants_.end();
  if (found == constants_.end()) refuse(joined("input ", i, " is not a constant"));
  return *found->second;
}

std::vector<std::int64_t> OnnxOperands::integers(std::size_t i) const {
  const OnnxConstant& from = constant(i);
  if (from.type != OnnxType::i64) refuse(joined("input ", i, " is not int64"));
  std::vector<std::int64_t> values(from.bytes.size() / sizeof(std::int64_t));
  std::memcpy(values.data(), from.bytes.data(), values.size() * sizeof(std::int64_t));
  return values;
}

std::vector<std::int64_t> OnnxOperands::integers(const char* name, std::vector<std::int64_t> value) const {
  return attribute(node_, name, std::move(value));
}

std::int64_t OnnxOperands::integer(const char* name, std::int64_t value) const { return attribute(node_, name, value); }

float OnnxOperands::number(const char* name, float value) const { return attribute(node_, name, value); }

void OnnxOperands::refuse(const std::string& why) const {
  fail("[onnx] node '", node_.name, "', ", node_.op, ": ", why);
}

}  // namespace svnet::io
