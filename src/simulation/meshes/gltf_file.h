#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_files.h"

namespace svnet::simulation {

/// A glTF 2.0 file without its meaning: the JSON and the numbers and bytes that it points to
/// (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html). Everything throws Error that begins with the file's
/// name for what is missing, of the wrong type, or beyond the end of what it lies in.
class GltfFile {
 public:
  using Json = nlohmann::json;

  /// A GLB, or JSON. Also throws Error if the file requires an extension that is not read, by its name and with
  /// what to do. `file` and `files` must live as long.
  GltfFile(std::string_view file, const MeshFiles& files);

  const Json& root() const { return json_; }

  /// Item `index` of an array at the root.
  const Json& item(const char* array, std::size_t index) const;
  /// A member that is an index, or none if there is no such member.
  std::optional<std::size_t> index(const Json& object, const char* member) const;
  double number(const Json& object, const char* member, double otherwise) const;
  /// `count` numbers, or `otherwise`.
  std::vector<double> numbers(const Json& object, const char* member, std::vector<double> otherwise) const;
  std::string text(const Json& object, const char* member) const;
  /// A member that is an object; an empty one if there is none.
  const Json& object(const Json& object, const char* member) const;
  /// What the object has of an extension; an empty object if it has nothing.
  const Json& extension(const Json& object, const char* name) const;

  /// `width` numbers per element, in [0, 1] or [-1, 1] if they are normalised integers.
  struct Numbers {
    std::size_t width = 1;
    std::vector<double> values;
    std::size_t count() const { return values.size() / width; }
  };
  /// `normalise`: integers are normalised, whatever the accessor says.
  Numbers accessor(std::size_t index, bool normalise = false) const;

  std::string_view buffer_view(std::size_t index) const;
  /// The bytes of a "data:" URI with base64; none for any other URI.
  std::optional<std::string> data_of_uri(const std::string& uri) const;
  const MeshFiles& files() const { return files_; }

 private:
  template <class... Parts>
  void check_here(bool condition, const Parts&... parts) const;
  std::string_view buffer(std::size_t index) const;
  void check_extensions() const;
  void add_values(const Json& accessor, const Json& where, std::size_t count, std::size_t width, bool normalise,
                  std::vector<double>& to) const;

  const MeshFiles& files_;
  Json json_;
  std::string_view binary_;                                  // of a GLB
  mutable std::vector<std::optional<std::string>> buffers_;  // that do not lie in the file, once read
};

/// With "%20" and the like as the bytes that they stand for (RFC 3986, section 2.1).
std::string decoded_uri(std::string_view uri);

}  // namespace svnet::simulation
