// Names of the folders and images of a dataset, and of its manifest and other files beside them: a path per line,
// which becomes an empty file, or a folder if it ends with '/'.
#include <filesystem>
#include <fstream>

#include "base/parallel.h"
#include "fuzz_target.h"
#include "io/views/dataset_folder.h"
#include "io/views/dataset_notes.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::fuzz;

namespace fs = std::filesystem;

namespace {

void make(const fs::path& root, std::string_view line) {
  const fs::path relative(line);
  if (line.empty() || line.size() > 240 || line.find('\0') != std::string_view::npos || relative.is_absolute()) return;
  for (const fs::path& part : relative)
    if (part == ".." || part.native().size() > 100) return;
  std::error_code ignored;
  fs::create_directories(relative.has_filename() ? root / relative.parent_path() : root / relative, ignored);
  if (relative.has_filename()) std::ofstream(root / relative);
}

}  // namespace

SVNET_FUZZ_TARGET(dataset_names) {
  const TemporaryFolder folder;
  std::string_view text = text_of(input);
  for (int lines = 0; lines < 32 && !text.empty(); ++lines) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    make(folder.path(), line);
  }
  accept([&] {
    const ViewDataset dataset = io::read_view_dataset(folder.path());
    Parallel alone(1);
    for (Index pose = 0; pose < static_cast<Index>(dataset.poses.size()); ++pose) io::find_top_depth(dataset, pose);
    io::dataset_notes(dataset, alone);
    io::fingerprint(dataset, alone);
  });
}
