#include "io/tensors/tensor_file.h"

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <list>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/bf16.h"
#include "base/crc32c.h"
#include "base/finite.h"
#include "base/parallel.h"
#include "io/tensors/safetensors.h"
#include "nn/kernels/int8/int8_weights.h"

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

constexpr const char* kScale = ".scale";

bool is_scale(const std::string& name) { return name.ends_with(kScale); }

/// Copies the elements of a tensor of f32, bytes of any alignment.
Tensor f32_copy(const SafetensorsTensor& from) {
  Tensor tensor = Tensor::empty(from.shape);
  std::memcpy(tensor.data<float>(), from.bytes.data(), from.bytes.size());
  return tensor;
}

Tensor bf16_copy(const SafetensorsTensor& from) {
  Tensor tensor = Tensor::empty(from.shape);
  read_bf16(from.bytes, {tensor.data<float>(), static_cast<std::size_t>(tensor.size())});
  return tensor;
}

kernels::ChannelShape channels_of(const Shape& shape) {
  return {.outer = shape.empty() ? 1 : element_count(shape) / shape.back(),
          .channels = shape.empty() ? 1 : shape.back()};
}

Tensor int8_copy(const std::string& path, const SafetensorsFile& raw, const SafetensorsTensor& from) {
  const SafetensorsTensor& scale = raw.at(from.name + kScale);
  const kernels::ChannelShape shape = channels_of(from.shape);
  check(scale.dtype == "F32" && scale.shape == Shape{shape.channels}, path, ": tensor '", scale.name, "' is ",
        scale.dtype, " ", to_string(scale.shape), ", expected F32 ", shape.channels);
  const Tensor scales = f32_copy(scale);
  Tensor tensor = Tensor::empty(from.shape);
  const std::span values(reinterpret_cast<const std::int8_t*>(from.bytes.data()), from.bytes.size());
  kernels::from_int8(shape, values, scales.values<float>(), tensor.data<float>());
  return tensor;
}

Tensor copied(const std::string& path, const SafetensorsFile& raw, const SafetensorsTensor& from) {
  check(from.dtype == "F32" || from.dtype == "BF16" || from.dtype == "I8", path, ": tensor '", from.name, "' is ",
        from.dtype, ", expected F32, BF16 or I8");
  Tensor tensor = from.dtype == "F32"    ? f32_copy(from)
                  : from.dtype == "BF16" ? bf16_copy(from)
                                         : int8_copy(path, raw, from);
  check_finite(path, from.name, tensor);
  return tensor;
}

std::string checksum_of(std::span<const std::byte> bytes) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(8)
       << crc32c({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return text.str();
}

std::vector<std::string> checksums_of(std::span<const SafetensorsTensor> tensors) {
  std::vector<std::string> checksums(tensors.size());
  Parallel::shared().for_chunks(static_cast<Index>(tensors.size()), 1, [&](Index i, Index, int) {
    const auto at = static_cast<std::size_t>(i);
    checksums[at] = checksum_of(tensors[at].bytes);
  });
  return checksums;
}

void check_checksums(const std::string& path, const nlohmann::json& description,
                     std::span<const SafetensorsTensor> tensors) {
  if (!description.contains("checksums")) return;
  const nlohmann::json& wanted = description.at("checksums");
  const std::vector<std::string> checksums = checksums_of(tensors);
  for (std::size_t i = 0; i < tensors.size(); ++i)
    check(!wanted.contains(tensors[i].name) || wanted.at(tensors[i].name) == checksums[i], path, ": tensor '",
          tensors[i].name, "' does not have its checksum: the file is damaged or was changed; copy or train it again");
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
  std::vector<SafetensorsTensor> wanted;
  std::ranges::copy_if(raw.tensors(), std::back_inserter(wanted), [&](const SafetensorsTensor& tensor) {
    return left_out.empty() || !tensor.name.starts_with(left_out);
  });
  check_checksums(file.path_, *file.description_, wanted);
  for (const auto& tensor : wanted)
    if (!is_scale(tensor.name)) file.tensors_.push_back({tensor.name, copied(file.path_, raw, tensor)});
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

void TensorFile::add(const std::string& name, const Tensor& tensor, StoredPrecision precision) {
  tensors_.push_back({name, tensor, precision});
}

void TensorFile::add(const std::string& prefix, const Parameters& parameters) {
  for (const auto& [name, tensor] : parameters.items()) add(path_of(prefix, name), tensor);
}

const Tensor& TensorFile::at(const std::string& name, const Shape& shape) const {
  for (const auto& [known, tensor, precision] : tensors_) {
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
  for (const auto& [name, tensor, precision] : tensors_)
    check(parameters.contains(name), path_, ": holds tensor '", name, "' (", to_string(tensor.shape()),
          "), for which the network has no place");
}

void TensorFile::write(const std::filesystem::path& path) const {
  std::vector<SafetensorsTensor> raw;
  std::list<std::vector<std::byte>> rounded;  // the bytes of tensors that are not f32
  const auto keep = [&](const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return std::span<const std::byte>(rounded.emplace_back(bytes.begin(), bytes.end()));
  };
  for (const auto& [name, tensor, precision] : tensors_) {
    check_finite(path.string(), name, tensor);
    switch (precision) {
      case StoredPrecision::f32:
        raw.push_back({name, "F32", tensor.shape(), std::as_bytes(tensor.values<float>())});
        break;
      case StoredPrecision::bf16:
        raw.push_back({name, "BF16", tensor.shape(), rounded.emplace_back(bf16_bytes(tensor.values<float>()))});
        break;
      case StoredPrecision::int8: {
        const kernels::ChannelShape shape = channels_of(tensor.shape());
        const kernels::Int8Weights weights = kernels::int8_weights(shape, tensor.data<float>());
        raw.push_back({name, "I8", tensor.shape(), keep(weights.values)});
        raw.push_back({name + kScale, "F32", {shape.channels}, keep(weights.scales)});
        break;
      }
    }
  }
  nlohmann::json description = *description_;
  description["format"] = kFormat;
  const std::vector<std::string> checksums = checksums_of(raw);
  nlohmann::json& by_name = description["checksums"] = nlohmann::json::object();
  for (std::size_t i = 0; i < raw.size(); ++i) by_name[raw[i].name] = checksums[i];
  write_safetensors(path, raw, {{"svnet", description.dump()}});
}

}  // namespace svnet::io
