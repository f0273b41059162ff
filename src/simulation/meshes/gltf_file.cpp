#include "gltf_file.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace svnet::simulation {
namespace {

using Json = GltfFile::Json;

constexpr std::size_t kMostElements = 15'000'000;  // of an accessor

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

struct Component {
  std::size_t bytes;
  bool is_float, is_signed;
};

Component component(std::uint64_t type) {
  switch (type) {
    case 5120:
      return {1, false, true};
    case 5121:
      return {1, false, false};
    case 5122:
      return {2, false, true};
    case 5123:
      return {2, false, false};
    case 5125:
      return {4, false, false};
    case 5126:
      return {4, true, true};
    default:  // numbers of a file, not an enum
      return {0, false, false};
  }
}

double value_at(const char* bytes, const Component& kind, bool normalise) {
  if (kind.is_float) {
    float value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, kind.bytes);
  const std::size_t shift = 32 - 8 * kind.bytes;
  const double value = kind.is_signed ? static_cast<double>(static_cast<std::int32_t>(bits << shift) >> shift)
                                      : static_cast<double>(bits);
  if (!normalise) return value;
  return std::max(value / (std::exp2(8.0 * static_cast<double>(kind.bytes) - (kind.is_signed ? 1 : 0)) - 1), -1.0);
}

/// What to do about an extension that is not read.
const char* advice(const std::string& extension) {
  for (const auto& [name, text] : {std::pair("KHR_draco_mesh_compression", "; save it without Draco compression"),
                                   std::pair("EXT_meshopt_compression", "; save it without meshopt compression"),
                                   std::pair("KHR_meshopt_compression", "; save it without meshopt compression"),
                                   std::pair("KHR_texture_basisu", "; convert its KTX2 textures to PNG or JPEG")})
    if (extension == name) return text;
  return "; save it without that extension";
}

}  // namespace

std::string decoded_uri(std::string_view uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    std::uint8_t byte = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      result += static_cast<char>(byte);
      i += 2;
    } else {
      result += uri[i];
    }
  }
  return result;
}

template <class... Parts>
void GltfFile::check_here(bool condition, const Parts&... parts) const {
  if (!condition) fail(files_.name(), ": ", parts...);
}

GltfFile::GltfFile(std::string_view file, const MeshFiles& files) : files_(files) {
  std::string_view text = file;
  if (file.starts_with("glTF")) {
    check_here(file.size() >= 20, "is a GLB of ", file.size(), " bytes; is the file incomplete?");
    check_here(word_at(file, 4) == 2, "is of glTF version ", word_at(file, 4), ", expected 2");
    const std::size_t length = word_at(file, 8), json_length = word_at(file, 12);
    check_here(length <= file.size(), "has ", file.size(), " of ", length, " bytes; is the file incomplete?");
    check_here(file.substr(16, 4) == "JSON" && json_length <= file.size() - 20,
               "has no whole JSON chunk; is the file incomplete?");
    text = file.substr(20, json_length);
    const std::size_t next = 20 + json_length;
    if (next + 8 <= file.size() && file.substr(next + 4, 4) == std::string_view("BIN\0", 4)) {
      const std::size_t binary_length = word_at(file, next);
      check_here(binary_length <= file.size() - next - 8, "has a cut off BIN chunk; is the file incomplete?");
      binary_ = file.substr(next + 8, binary_length);
    }
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  json_ = Json::parse(text, nullptr, false);
  check_here(!json_.is_discarded() && json_.is_object(), "its JSON cannot be parsed; is this a glTF file?");
  const std::string version = this->text(object(json_, "asset"), "version");
  check_here(version.starts_with("2."), "is of glTF version '", printable(version), "', expected 2.0");
  check_extensions();
}

void GltfFile::check_extensions() const {
  const auto required = json_.find("extensionsRequired");
  if (required == json_.end()) return;
  check_here(required->is_array(), "'extensionsRequired' is not a list");
  for (const Json& name : *required) {
    check_here(name.is_string(), "'extensionsRequired' holds what is not a name");
    const auto extension = name.get<std::string>();
    bool is_read = false;
    for (const char* known : {"KHR_texture_transform", "EXT_texture_webp", "KHR_mesh_quantization",
                              "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness"})
      is_read |= extension == known;
    check_here(is_read, "requires the extension ", printable(extension), ", which is not read", advice(extension));
  }
}

const Json& GltfFile::item(const char* array, std::size_t index) const {
  const auto all = json_.find(array);
  const std::size_t count = all != json_.end() && all->is_array() ? all->size() : 0;
  check_here(index < count, "asks for number ", index, " of ", count, " ", array);
  const Json& found = (*all)[index];
  check_here(found.is_object(), array, "[", index, "] is not an object");
  return found;
}

std::optional<std::size_t> GltfFile::index(const Json& object, const char* member) const {
  const auto found = object.find(member);
  if (found == object.end()) return std::nullopt;
  check_here(found->is_number_unsigned(), "'", member, "' is not a whole number");
  return found->get<std::size_t>();
}

double GltfFile::number(const Json& object, const char* member, double otherwise) const {
  const auto found = object.find(member);
  if (found == object.end()) return otherwise;
  check_here(found->is_number(), "'", member, "' is not a number");
  return found->get<double>();
}

std::vector<double> GltfFile::numbers(const Json& object, const char* member, std::vector<double> otherwise) const {
  const auto found = object.find(member);
  if (found == object.end()) return otherwise;
  check_here(found->is_array() && found->size() == otherwise.size(), "'", member, "' is not a list of ",
             otherwise.size(), " numbers");
  for (std::size_t i = 0; i < otherwise.size(); ++i) {
    check_here((*found)[i].is_number(), "'", member, "' is not a list of ", otherwise.size(), " numbers");
    otherwise[i] = (*found)[i].get<double>();
  }
  return otherwise;
}

std::string GltfFile::text(const Json& object, const char* member) const {
  const auto found = object.find(member);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json& GltfFile::object(const Json& object, const char* member) const {
  static const Json kNone = Json::object();
  const auto found = object.find(member);
  return found != object.end() && found->is_object() ? *found : kNone;
}

const Json& GltfFile::extension(const Json& of, const char* name) const {
  return object(object(of, "extensions"), name);
}

std::optional<std::string> GltfFile::data_of_uri(const std::string& uri) const {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  check_here(comma != std::string::npos && uri.substr(0, comma).ends_with(";base64"),
             "has a data URI that is not in base64");
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int filled = 0;
  for (const char c : std::string_view(uri).substr(comma + 1)) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    check_here(digit != std::string_view::npos, "has a data URI that is not in base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if ((filled += 6) >= 8) bytes += static_cast<char>(bits >> (filled -= 8) & 255);
  }
  return bytes;
}

std::string_view GltfFile::buffer(std::size_t index) const {
  const Json& description = item("buffers", index);
  const std::string uri = text(description, "uri");
  if (uri.empty()) {
    check_here(index == 0 && !binary_.empty(), "buffer ", index, " has neither contents nor a file",
               extension(description, "EXT_meshopt_compression").empty()
                   ? "; is the file incomplete?"
                   : ": the mesh is compressed by EXT_meshopt_compression; save it without that");
    return binary_;
  }
  buffers_.resize(json_.at("buffers").size());
  auto& contents = buffers_[index];
  if (!contents) contents = data_of_uri(uri);
  if (!contents) {
    const auto path = files_.find("buffer", decoded_uri(uri));
    check_here(path.has_value(), "its buffer '", printable(uri), "' is missing");
    contents = files_.contents(*path);
  }
  return *contents;
}

std::string_view GltfFile::buffer_view(std::size_t number) const {
  const Json& view = item("bufferViews", number);
  const auto from = index(view, "buffer"), length = index(view, "byteLength");
  check_here(from && length, "bufferViews[", number, "] has no buffer or no length");
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    check_here(extension(view, name).empty(), "is compressed by ", name, ", which is not read; save it without that");
  const std::string_view all = buffer(*from);
  const std::size_t offset = index(view, "byteOffset").value_or(0);
  check_here(offset <= all.size() && *length <= all.size() - offset, "bufferViews[", number, "] ends at byte ", offset,
             " + ", *length, " of ", all.size(), "; is the file incomplete?");
  return all.substr(offset, *length);
}

void GltfFile::add_values(const Json& accessor, const Json& where, std::size_t count, std::size_t width, bool normalise,
                          std::vector<double>& to) const {
  const Component kind = component(index(accessor, "componentType").value_or(0));
  check_here(kind.bytes > 0, "an accessor has no known component type");
  const std::size_t view = *index(where, "bufferView"), size = kind.bytes * width;
  const std::string_view bytes = buffer_view(view);
  const std::size_t stride = std::max(index(item("bufferViews", view), "byteStride").value_or(0), size);
  const std::size_t offset = index(where, "byteOffset").value_or(0);
  check_here(stride < 4096 && (count == 0 || (offset <= bytes.size() && bytes.size() - offset >= size &&
                                              (bytes.size() - offset - size) / stride >= count - 1)),
             "an accessor of ", count, " elements does not fit into bufferViews[", view, "] of ", bytes.size(),
             " bytes");
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < width; ++k)
      to.push_back(value_at(bytes.data() + offset + i * stride + k * kind.bytes, kind, normalise));
}

GltfFile::Numbers GltfFile::accessor(std::size_t number, bool normalise) const {
  const Json& description = item("accessors", number);
  const std::string type = text(description, "type");
  Numbers result;
  result.width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
  check_here(result.width > 0, "accessors[", number, "] is of type '", printable(type), "'");
  const std::size_t count = index(description, "count").value_or(0);
  check_here(count <= kMostElements, "accessors[", number, "] promises ", count, " elements");
  const auto is_normalised = description.find("normalized");
  normalise |= is_normalised != description.end() && is_normalised->is_boolean() && is_normalised->get<bool>();
  if (index(description, "bufferView"))
    add_values(description, description, count, result.width, normalise, result.values);
  else
    result.values.assign(count * result.width, 0.0);
  const Json& sparse = object(description, "sparse");
  if (sparse.empty()) return result;
  const std::size_t changes = index(sparse, "count").value_or(0);
  const Json &places = object(sparse, "indices"), &values = object(sparse, "values");
  check_here(changes <= count && index(places, "bufferView") && index(values, "bufferView"), "accessors[", number,
             "] is sparse without its values");
  std::vector<double> at, to;
  add_values(places, places, changes, 1, false, at);
  add_values(description, values, changes, result.width, normalise, to);
  for (std::size_t i = 0; i < changes; ++i) {
    check_here(at[i] >= 0 && at[i] < static_cast<double>(count), "accessors[", number, "] changes element ", at[i],
               " of ", count);
    std::copy_n(to.begin() + static_cast<std::ptrdiff_t>(i * result.width), result.width,
                result.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(at[i]) * result.width));
  }
  return result;
}

}  // namespace svnet::simulation
