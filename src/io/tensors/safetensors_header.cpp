#include "io/tensors/safetensors_header.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/text.h"

namespace svnet::io {
namespace {

using Json = nlohmann::json;

struct Dtype {
  const char* name;
  std::uint64_t size;
};
/// In the order in which their data are written.
constexpr Dtype kDtypes[] = {{"U64", 8},     {"I64", 8},     {"F64", 8}, {"C64", 8}, {"F32", 4}, {"U32", 4},
                             {"I32", 4},     {"BF16", 2},    {"F16", 2}, {"U16", 2}, {"I16", 2}, {"F8_E8M0", 1},
                             {"F8_E4M3", 1}, {"F8_E5M2", 1}, {"I8", 1},  {"U8", 1},  {"BOOL", 1}};

constexpr std::uint64_t kLargestData = std::uint64_t{1} << 62;

std::string place(const std::string& file, const std::string& tensor) {
  return file + ": tensor '" + printable(tensor) + "': ";
}

/// The header's JSON; the parser alone would keep the last of several equal keys.
Json parsed(const std::string& file, std::string_view text) {
  constexpr int kDeepest = 4;
  std::vector<std::set<std::string>> keys(kDeepest + 1);
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    check(depth <= kDeepest, file, ": header is nested too deeply");
    if (event == Json::parse_event_t::object_start && depth < kDeepest)
      keys[static_cast<std::size_t>(depth) + 1].clear();
    if (event == Json::parse_event_t::key) {
      const auto key = value.get<std::string>();
      check(keys[static_cast<std::size_t>(depth)].insert(key).second, file, ": header has '", printable(key),
            "' twice");
    }
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const Json::parse_error& error) {
    fail(file, ": header is not JSON (at its byte ", error.byte, "); the file is damaged");
  } catch (const Json::exception&) {
    fail(file, ": header is not JSON; the file is damaged");
  }
}

SafetensorsMetadata metadata_of(const std::string& file, const Json& value) {
  check(value.is_object(), file, ": '", kSafetensorsMetadataKey, "' in the header is not an object");
  SafetensorsMetadata metadata;
  for (const auto& [name, text] : value.items()) {
    check(text.is_string(), file, ": metadata '", printable(name), "' is not a string");
    metadata[name] = text.get<std::string>();
  }
  return metadata;
}

std::vector<std::uint64_t> counts(const std::string& where, const Json& value, const char* key) {
  const Json& list = value.at(key);
  check(list.is_array(), where, key, " is not a list");
  std::vector<std::uint64_t> result;
  for (const Json& item : list) {
    check(item.is_number_unsigned() && item.get<std::uint64_t>() <= kLargestData, where, key,
          " holds something that is not a size");
    result.push_back(item.get<std::uint64_t>());
  }
  return result;
}

SafetensorsEntry entry_of(const std::string& file, const std::string& name, const Json& value) {
  const std::string where = place(file, name);
  check(value.is_object(), where, "its entry in the header is not an object");
  for (const char* key : {"dtype", "shape", "data_offsets"})
    check(value.contains(key), where, "its entry in the header has no ", key);
  check(value.size() == 3, where, "its entry in the header has keys beside dtype, shape and data_offsets");
  check(value.at("dtype").is_string(), where, "dtype is not a string");
  const std::vector<std::uint64_t> shape = counts(where, value, "shape"),
                                   offsets = counts(where, value, "data_offsets");
  check(offsets.size() == 2 && offsets[0] <= offsets[1], where, "data_offsets are not a begin and an end");
  return {name, value.at("dtype").get<std::string>(), {shape.begin(), shape.end()}, offsets[0], offsets[1]};
}

void check_data(const std::string& file, const std::vector<SafetensorsEntry>& entries, std::uint64_t data_size) {
  std::uint64_t position = 0;
  for (const SafetensorsEntry& entry : entries) {
    const std::string where = place(file, entry.name);
    check(entry.end <= data_size, where, "ends at byte ", entry.end, " of the data, the file has ", data_size,
          "; it is incomplete");
    const std::uint64_t size = safetensors_size(file, entry);
    check(entry.end - entry.begin == size, where, "has ", entry.end - entry.begin, " bytes, its dtype ", entry.dtype,
          " and shape need ", size);
    check(entry.begin >= position, where, "overlaps the tensor before it");
    check(entry.begin == position, where, entry.begin - position, " bytes before it belong to no tensor");
    position = entry.end;
  }
  check(position == data_size, file, ": ", data_size - position, " bytes at the end belong to no tensor");
}

}  // namespace

std::size_t safetensors_dtype_rank(const std::string& file, const std::string& tensor, const std::string& dtype) {
  const auto found =
      std::find_if(std::begin(kDtypes), std::end(kDtypes), [&](const Dtype& d) { return d.name == dtype; });
  check(found != std::end(kDtypes), place(file, tensor), "dtype '", printable(dtype), "' is not supported");
  return static_cast<std::size_t>(found - std::begin(kDtypes));
}

std::uint64_t safetensors_size(const std::string& file, const SafetensorsEntry& entry) {
  std::uint64_t size = kDtypes[safetensors_dtype_rank(file, entry.name, entry.dtype)].size;
  for (const Index extent : entry.shape) {
    check(extent >= 0, place(file, entry.name), "has a negative dimension, ", extent);
    if (extent == 0) return 0;
  }
  for (const Index extent : entry.shape) {
    check(size <= kLargestData / static_cast<std::uint64_t>(extent), place(file, entry.name), "its shape is too large");
    size *= static_cast<std::uint64_t>(extent);
  }
  return size;
}

SafetensorsHeader parse_safetensors_header(const std::string& file, std::string_view text, std::uint64_t data_size) {
  check(!text.empty() && text.front() == '{', file, ": header is not a JSON object; is it a safetensors file?");
  const Json json = parsed(file, text);
  check(json.is_object(), file, ": header is not a JSON object; is it a safetensors file?");
  SafetensorsHeader header;
  for (const auto& [name, value] : json.items()) {
    if (name == kSafetensorsMetadataKey) {
      header.metadata = metadata_of(file, value);
    } else {
      header.entries.push_back(entry_of(file, name, value));
    }
  }
  std::sort(header.entries.begin(), header.entries.end(), [](const SafetensorsEntry& a, const SafetensorsEntry& b) {
    return std::tie(a.begin, a.end, a.name) < std::tie(b.begin, b.end, b.name);
  });
  check_data(file, header.entries, data_size);
  return header;
}

std::string safetensors_header_text(const std::string& file, const SafetensorsHeader& header) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (!header.metadata.empty()) json[kSafetensorsMetadataKey] = header.metadata;
  for (const SafetensorsEntry& entry : header.entries) {
    nlohmann::ordered_json value;
    value["dtype"] = entry.dtype;
    value["shape"] = entry.shape;
    value["data_offsets"] = {entry.begin, entry.end};
    json[entry.name] = std::move(value);
  }
  try {
    std::string text = json.dump();
    text.append((8 - text.size() % 8) % 8, ' ');
    return text;
  } catch (const Json::exception&) {
    fail(file, ": the names of its tensors and its metadata must be UTF-8");
  }
}

}  // namespace svnet::io
