#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace svnet::fuzz {

/// Where the seeds of all targets go: FOLDER/<target>/<name>, and words that its input is made of:
/// FOLDER/<target>.dict.
class Seeds {
 public:
  explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The path of a seed that a writer fills.
  std::filesystem::path path(const std::string& target, const std::string& name) const;
  void add(const std::string& target, const std::string& name, std::string_view contents) const;
  /// Files of tests/fixtures/<folder>; all whose names end with `ending`.
  void copy(const std::string& target, const std::string& fixtures, std::string_view ending,
            std::string_view before = "") const;
  void add_word(const std::string& target, std::string_view word) const;

 private:
  std::filesystem::path folder_;
};

void add_documents(const Seeds&);
void add_meshes(const Seeds&);
void add_models(const Seeds&);
void add_pictures(const Seeds&);
void add_requests(const Seeds&);

}  // namespace svnet::fuzz
