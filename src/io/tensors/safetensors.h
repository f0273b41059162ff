#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

/// One tensor, row-major, little endian. The bytes belong to someone else; in a file they are aligned for their dtype
/// in files that write_safetensors or the Python package wrote, in others perhaps not: copy them.
struct SafetensorsTensor {
  std::string name;
  std::string dtype;  // "F32", "F64", "U64", "I64", "BF16", …
  std::vector<Index> shape;
  std::span<const std::byte> bytes;
};

using SafetensorsMetadata = std::map<std::string, std::string>;

// The safetensors format (huggingface.co/docs/safetensors): the length N of the header, 8 bytes little endian; the
// header, N bytes of JSON, {"__metadata__": {name: text}, name: {"dtype", "shape", "data_offsets": [begin, end)}},
// offsets counted from the header's end; the tensors, without holes.

/// A file that is mapped into memory, read-only: only what is used is read from disk. The file must not be written to
/// or cut while it is open; replacing it as a whole is safe.
class SafetensorsFile {
 public:
  /// Throws Error that names the file and the tensor unless the file is exactly what the format says: header of at most
  /// 100 MB, known dtypes of whole bytes, no name twice, data as long as dtype and shape say, no overlap, no hole, no
  /// rest.
  explicit SafetensorsFile(const std::filesystem::path& path);
  /// The same for the contents of a file that are in memory and stay there; `name` is what errors call them.
  SafetensorsFile(std::string name, std::span<const std::byte> contents);
  ~SafetensorsFile();
  SafetensorsFile(SafetensorsFile&&) noexcept;
  SafetensorsFile& operator=(SafetensorsFile&&) noexcept;

  /// In the order of the data in the file. The bytes are there as long as this object.
  const std::vector<SafetensorsTensor>& tensors() const { return tensors_; }
  /// nullptr if there is none of that name.
  const SafetensorsTensor* find(const std::string& name) const;
  /// Throws Error that names the file if there is none of that name.
  const SafetensorsTensor& at(const std::string& name) const;
  const SafetensorsMetadata& metadata() const { return metadata_; }

 private:
  class Mapping;
  void parse(std::span<const std::byte> bytes);

  std::string path_;
  std::unique_ptr<Mapping> mapping_;
  std::vector<SafetensorsTensor> tensors_;
  std::map<std::string, std::size_t> by_name_;
  SafetensorsMetadata metadata_;
};

/// Replaces the file as a whole with the bytes that the Python package writes for the same tensors (metadata sorted by
/// name): the widest dtypes first, then by name. Throws Error for what SafetensorsFile would not read.
void write_safetensors(const std::filesystem::path& path, std::span<const SafetensorsTensor> tensors,
                       const SafetensorsMetadata& metadata = {});

}  // namespace svnet
