#pragma once
#include <set>
#include <string>
#include <vector>

#include "shell.h"

namespace svnet {

/// A folder with complete inputs for every command, made once per process in a few hundred milliseconds:
///   data/            write_small_dataset: categories ball, cone, cube, ring, 2 objects of each, 4 views of each
///   weights/         tiny_xception.h5 in Keras' legacy layout, random weights
///   config.yaml      uses data and weights; all sizes are small; --output gives the run folder
///   features.h5, scores.h5, model.safetensors, top.png, poses.csv
class Workplace {
 public:
  Workplace();

  /// Runs shell commands in the folder, with svnet's programs on the PATH.
  Ran run(const std::string& command) const;
  /// Runs shell commands and requires exit 0 and an empty stderr.
  std::string output_of(const std::string& command) const;

  std::filesystem::path operator/(const std::string& name) const { return folder_.path() / name; }
  const TemporaryFolder& folder() const { return folder_; }
  /// The paths of all files and folders, relative to the folder.
  std::set<std::string> entries() const;

 private:
  TemporaryFolder folder_;
};

/// Writes tiny_xception with random weights in Keras' legacy layout and order. `swapped`: exchange two layers
/// of the same shapes.
void write_tiny_weights(const std::filesystem::path& path, bool swapped = false);

/// The lines of a text, without line breaks.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace svnet
