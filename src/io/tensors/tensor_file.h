#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nn/graph/parameters.h"
#include "nn/graph/stored_precision.h"

namespace svnet::io {

/// A safetensors file of svnet: tensors and a JSON object that describes them, which is the entry "svnet" of the
/// metadata. Tensors are F32; BF16; or I8 with a tensor "<name>.scale" (C) of F32 beside them, where C is the size of
/// the last axis: an element is value · scale. In memory all are f32. Its "checksums" are the CRC-32C of the bytes of
/// each tensor, by name, as 8 hexadecimal digits; files of earlier versions have none.
class TensorFile {
 public:
  /// Throws Error that names the file unless the description has this `kind` ("model", "checkpoint", "weights") and
  /// this version's "format", and the tensors their checksums. Tensors whose names begin with `left_out` are skipped;
  /// if it is empty, all are read.
  static TensorFile read(const std::filesystem::path& path, const std::string& kind, const std::string& left_out = "");
  /// The same without any tensor.
  static TensorFile read_description(const std::filesystem::path& path, const std::string& kind);
  /// As read, for the contents of a file in memory. Errors call it `name`.
  static TensorFile parse(const std::string& name, std::span<const std::byte> contents, const std::string& kind);

  TensorFile();
  TensorFile(TensorFile&&) noexcept;
  TensorFile& operator=(TensorFile&&) noexcept;
  ~TensorFile();

  nlohmann::json& description() { return *description_; }
  const nlohmann::json& description() const { return *description_; }
  /// A member of the description. Throws Error that names file and member if it is missing or of another type.
  template <class T>
  T get(const std::string& member) const;

  /// `precision`: how the file holds it. Its values are rounded when the file is written.
  void add(const std::string& name, const Tensor& tensor, StoredPrecision precision = StoredPrecision::f32);
  /// Adds every parameter as "prefix/name", or as "name" if the prefix is empty.
  void add(const std::string& prefix, const Parameters& parameters);
  /// Throws Error that names the file and the tensor if it is missing or has another shape.
  const Tensor& at(const std::string& name, const Shape& shape) const;
  /// The parameters of the graph, under the names that add() gives them. The trainable ones require gradients.
  Parameters parameters(const std::string& prefix, const Graph& graph) const;

  /// Throws Error that names the file and the tensor if there is one that is not among `parameters`.
  void check_holds_only(const Parameters& parameters) const;

  /// Replaces the file as a whole, and adds "format" to the description.
  void write(const std::filesystem::path& path) const;

  const std::string& path() const { return path_; }

 private:
  static TensorFile described(const class SafetensorsFile& raw, const std::string& path, const std::string& kind);
  static TensorFile from(const SafetensorsFile& raw, const std::string& path, const std::string& kind,
                         const std::string& left_out);

  std::string path_;
  std::unique_ptr<nlohmann::json> description_;
  struct Entry {
    std::string name;
    Tensor tensor;
    StoredPrecision precision = StoredPrecision::f32;
  };
  std::vector<Entry> tensors_;
};

}  // namespace svnet::io
