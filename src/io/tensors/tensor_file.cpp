#include "io/tensors/tensor_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/finite.h"
#include "io/tensors/safetensors.h"

namespace svnet::io {
namespace {

constexpr int kFormat = 1;

std::string path_of(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "/" + name;
}

void check_finite(const std::string& path, const std::string& name, const Tensor& tensor) {
  if (const auto bad = first_not_finite(tensor.values<float>()))
    fail(path, ": tensor '", name, "' holds a value that is not finite at ", *bad);
}

Tensor copied(const std::string& path, const SafetensorsTensor& from) {
  check(from.dtype == "F32" || from.dtype == "BF16", path, ": tensor '", from.name, "' is ", from.dtype,
        ", expected F32 or BF16");
  Tensor tensor = Tensor::empty(from.shape);
  if (from.dtype == "F32") {
    std::memcpy(tensor.data<float>(), from.bytes.data(), from.bytes.size());
  } else {  // the upper halves of the floats
    std::vector<std::uint16_t> halves(from.bytes.size() / 2);
    std::memcpy(halves.data(), from.bytes.data(), from.bytes.size());
    std::ranges::transform(halves, tensor.data<float>(),
                           [](std::uint16_t half) { return std::bit_cast<float>(std::uint32_t{half} << 16); });
  }
  check_finite(path, from.name, tensor);
  return tensor;
}

}  // namespace

TensorFile::TensorFile() : description_(std::make_unique<nlohmann::json>(nlohmann::json::object())) {}
TensorFile::TensorFile(TensorFile&&) noexcept = default;
TensorFile& TensorFile::operator=(TensorFile&&) noexcept = default;
TensorFile::~TensorFile() = default;

TensorFile TensorFile::read(const std::filesystem::path& path, const std::string& kind, const std::string& left_out) {
  return from(SafetensorsFile(path), path.string(), kind, left_out);
}

TensorFile TensorFile::parse(const std::string& name, std::span<const std::byte> contents, const std::string& kind) {
  return from(SafetensorsFile(name, contents), name, kind, "");
}

TensorFile TensorFile::read_description(const std::filesystem::path& path, const std::string& kind) {
  return described(SafetensorsFile(path), path.string(), kind);
}

TensorFile TensorFile::from(const SafetensorsFile& raw, const std::string& path, const std::string& kind,
                            const std::string& left_out) {
  TensorFile file = described(raw, path, kind);
  for (const auto& tensor : raw.tensors())
    if (left_out.empty() || !tensor.name.starts_with(left_out))
      file.tensors_.emplace_back(tensor.name, copied(file.path_, tensor));
  return file;
}

TensorFile TensorFile::described(const SafetensorsFile& raw, const std::string& path, const std::string& kind) {
  TensorFile file;
  file.path_ = path;
  const auto entry = raw.metadata().find("svnet");
  check(entry != raw.metadata().end(), file.path_,
        ": a safetensors file, but not one that svnet wrote (no 'svnet' in its metadata)");
  try {
    *file.description_ = nlohmann::json::parse(entry->second);
  } catch (const nlohmann::json::exception& error) {
    fail(file.path_, ": metadata 'svnet': ", error.what());
  }
  check(file.description_->is_object(), file.path_, ": metadata 'svnet' is not a JSON object");
  check(file.get<std::string>("kind") == kind, file.path_, ": is a ", file.get<std::string>("kind"), ", expected a ",
        kind);
  check(file.get<int>("format") == kFormat, file.path_, ": has format ", file.get<int>("format"),
        ", this svnet reads format ", kFormat);
  return file;
}

template <class T>
T TensorFile::get(const std::string& member) const {
  try {
    return description_->at(member).get<T>();
  } catch (const nlohmann::json::exception& error) {
    fail(path_, ": metadata 'svnet', member '", member, "': ", error.what());
  }
}
template int TensorFile::get<int>(const std::string&) const;
template Index TensorFile::get<Index>(const std::string&) const;
template double TensorFile::get<double>(const std::string&) const;
template std::string TensorFile::get<std::string>(const std::string&) const;
template nlohmann::json TensorFile::get<nlohmann::json>(const std::string&) const;

void TensorFile::add(const std::string& name, const Tensor& tensor) { tensors_.emplace_back(name, tensor); }

void TensorFile::add(const std::string& prefix, const Parameters& parameters) {
  for (const auto& [name, tensor] : parameters.items()) add(path_of(prefix, name), tensor);
}

const Tensor& TensorFile::at(const std::string& name, const Shape& shape) const {
  for (const auto& [known, tensor] : tensors_) {
    if (known != name) continue;
    check(tensor.shape() == shape, path_, ": tensor '", name, "' is ", to_string(tensor.shape()), ", expected ",
          to_string(shape));
    return tensor;
  }
  fail(path_, ": there is no tensor '", name, "'");
}

Parameters TensorFile::parameters(const std::string& prefix, const Graph& graph) const {
  Parameters parameters;
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters) {
      const std::string name = node.parameter_name(spec);
      const Tensor& value = at(path_of(prefix, name), spec.shape);
      parameters.set(name, spec.trainable ? value.as_parameter() : value);
    }
  return parameters;
}

void TensorFile::check_holds_only(const Parameters& parameters) const {
  for (const auto& [name, tensor] : tensors_)
    check(parameters.contains(name), path_, ": holds tensor '", name, "' (", to_string(tensor.shape()),
          "), for which the network has no place");
}

void TensorFile::write(const std::filesystem::path& path) const {
  std::vector<SafetensorsTensor> raw;
  for (const auto& [name, tensor] : tensors_) check_finite(path.string(), name, tensor);
  for (const auto& [name, tensor] : tensors_)
    raw.push_back({name, "F32", tensor.shape(), std::as_bytes(tensor.values<float>())});
  nlohmann::json description = *description_;
  description["format"] = kFormat;
  write_safetensors(path, raw, {{"svnet", description.dump()}});
}

}  // namespace svnet::io
