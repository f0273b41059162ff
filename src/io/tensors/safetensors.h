#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"
#include "io/tensors/safetensors_header.h"

namespace svnet::io {

/// One tensor, row-major, little endian. It does not own its bytes. They may lie at any address: files of other writers
/// need not align them, so copy them before use.
struct SafetensorsTensor {
  std::string name;
  std::string dtype;  // "F32", "F64", "U64", "I64", "BF16", …
  std::vector<Index> shape;
  std::span<const std::byte> bytes;
};

// The safetensors format (huggingface.co/docs/safetensors): the length N of the header, 8 bytes little endian; the
// header, N bytes of JSON, {"__metadata__": {name: text}, name: {"dtype", "shape", "data_offsets": [begin, end]}},
// offsets counted from the end of the header; the data of the tensors, without gaps.

/// A file mapped into memory, read-only: only the pages that are used are read from disk. While it is open nobody may
/// write to the file or truncate it. To replace it as a whole is safe.
class SafetensorsFile {
 public:
  /// Throws Error that names the file and the tensor unless the file follows the format strictly: a header of at most
  /// 100 MB, known dtypes of whole bytes, unique names, data as long as dtype and shape need, and no overlap, gap or
  /// trailing bytes.
  explicit SafetensorsFile(const std::filesystem::path& path);
  /// The same for a file that is in memory. Errors call it `name`. `contents` must outlive this object.
  SafetensorsFile(std::string name, std::span<const std::byte> contents);
  ~SafetensorsFile();
  SafetensorsFile(SafetensorsFile&&) noexcept;
  SafetensorsFile& operator=(SafetensorsFile&&) noexcept;

  /// In the order of the data in the file. The bytes live as long as this object.
  const std::vector<SafetensorsTensor>& tensors() const { return tensors_; }
  /// nullptr if there is no tensor of that name.
  const SafetensorsTensor* find(const std::string& name) const;
  /// Throws Error that names the file if there is no tensor of that name.
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

/// Replaces the file as a whole. Writes the bytes of the Python package: the widest dtypes first, then by name, and the
/// metadata by name. Throws Error for tensors that SafetensorsFile would refuse.
void write_safetensors(const std::filesystem::path& path, std::span<const SafetensorsTensor> tensors,
                       const SafetensorsMetadata& metadata = {});

}  // namespace svnet::io
