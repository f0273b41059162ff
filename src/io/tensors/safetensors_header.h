#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "safetensors.h"

namespace svnet {

inline constexpr std::uint64_t kLargestSafetensorsHeader = 100'000'000;

/// Where a tensor lies, in bytes from the end of the header.
struct SafetensorsEntry {
  std::string name;
  std::string dtype;
  std::vector<Index> shape;
  std::uint64_t begin = 0, end = 0;
};

struct SafetensorsHeader {
  std::vector<SafetensorsEntry> entries;  // in the order of their data, without overlap or hole
  SafetensorsMetadata metadata;
};

/// Reads the JSON of a header whose data take `data_size` bytes. Throws Error that names `file`.
SafetensorsHeader parse_safetensors_header(const std::string& file, std::string_view json, std::uint64_t data_size);

/// The JSON, padded with spaces so that the data are aligned to 8. Throws Error that names `file` for text that is not
/// UTF-8.
std::string safetensors_header_text(const std::string& file, const SafetensorsHeader& header);

/// 0: the widest dtype, which comes first in a file. Throws Error for dtypes that are unknown or not of whole bytes.
std::size_t safetensors_dtype_rank(const std::string& file, const std::string& tensor, const std::string& dtype);
/// Bytes that dtype and shape need. Throws Error where that is no sensible number.
std::uint64_t safetensors_size(const std::string& file, const SafetensorsEntry& entry);

/// The key that is no tensor.
inline constexpr char kSafetensorsMetadataKey[] = "__metadata__";

}  // namespace svnet
