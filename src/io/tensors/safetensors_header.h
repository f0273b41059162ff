#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/index.h"

// The header of a safetensors file (format: io/tensors/safetensors.h).
namespace svnet::io {

/// Texts by name, which the header holds beside the tensors.
using SafetensorsMetadata = std::map<std::string, std::string>;

inline constexpr std::uint64_t kLargestSafetensorsHeader = 100'000'000;

/// A tensor of the header. Its data are the bytes [begin, end), counted from the end of the header.
struct SafetensorsEntry {
  std::string name;
  std::string dtype;
  std::vector<Index> shape;
  std::uint64_t begin = 0, end = 0;
};

struct SafetensorsHeader {
  std::vector<SafetensorsEntry> entries;  // in the order of their data, which are contiguous
  SafetensorsMetadata metadata;
};

/// Parses the JSON of a header that is followed by `data_size` bytes of data. Throws Error that names `file` unless it
/// follows the format.
SafetensorsHeader parse_safetensors_header(const std::string& file, std::string_view json, std::uint64_t data_size);

/// The JSON of a header, padded with spaces so that the data start at a multiple of 8 bytes. Throws Error that names
/// `file` for text that is not UTF-8.
std::string safetensors_header_text(const std::string& file, const SafetensorsHeader& header);

/// The rank of a dtype in the order in which a file stores them: 0 is the first, a widest one. Throws Error for dtypes
/// that are not known or have no whole number of bytes.
std::size_t safetensors_dtype_rank(const std::string& file, const std::string& tensor, const std::string& dtype);
/// The bytes that dtype and shape need. Throws Error for an unknown dtype or a size that overflows.
std::uint64_t safetensors_size(const std::string& file, const SafetensorsEntry& entry);

/// The key of the header that holds the metadata.
inline constexpr char kSafetensorsMetadataKey[] = "__metadata__";

}  // namespace svnet::io
