#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nn/graph/parameters.h"

namespace svnet {

/// A safetensors file of ours: F32 tensors, and one JSON value that says what they are, kept as the entry "svnet" of
/// the format's metadata.
class TensorFile {
 public:
  /// `kind` ("model", "checkpoint", "weights") must be the description's "kind", and "format" the number that this
  /// version writes. Throws Error that names the file. Tensors whose names begin with `left_out` (none where it is
  /// empty) are not read.
  static TensorFile read(const std::filesystem::path& path, const std::string& kind, const std::string& left_out = "");
  /// The same for the contents of a file that are in memory; `name` is what errors call them.
  static TensorFile parse(const std::string& name, std::span<const std::byte> contents, const std::string& kind);

  TensorFile();
  TensorFile(TensorFile&&) noexcept;
  TensorFile& operator=(TensorFile&&) noexcept;
  ~TensorFile();

  nlohmann::json& description() { return *description_; }
  /// A member of the description. Throws Error that names file and member where it is missing or of another type.
  template <class T>
  T get(const std::string& member) const;

  void add(const std::string& name, const Tensor& tensor);
  /// Every parameter as "prefix/name", or by its name alone where the prefix is empty.
  void add(const std::string& prefix, const Parameters& parameters);
  /// Throws Error that names the file and the tensor where it is missing or has another shape.
  const Tensor& at(const std::string& name, const Shape& shape) const;
  /// All parameters of the graph, called as add() calls them; the trainable ones are leaves of the tape.
  Parameters parameters(const std::string& prefix, const Graph& graph) const;

  /// Throws Error that names the file and a tensor where it holds one that is not among `parameters`.
  void check_holds_only(const Parameters& parameters) const;

  /// Replaces the file as a whole; "format" is added to the description.
  void write(const std::filesystem::path& path) const;

  const std::string& path() const { return path_; }

 private:
  static TensorFile from(const class SafetensorsFile& raw, const std::string& path, const std::string& kind,
                         const std::string& left_out);

  std::string path_;
  std::unique_ptr<nlohmann::json> description_;
  std::vector<std::pair<std::string, Tensor>> tensors_;
};

}  // namespace svnet
