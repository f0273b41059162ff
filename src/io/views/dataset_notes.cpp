#include "io/views/dataset_notes.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "io/images/image_file.h"

namespace svnet::io {
namespace {

std::string ignored_note(const ViewDataset& dataset) {
  constexpr std::size_t kShown = 3;
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, dataset.ignored.size()); ++i)
    names += (i == 0 ? "" : ", ") + printable(dataset.ignored[i]);
  return joined(dataset.root.string(), ": ", dataset.ignored.size(), " files or folders that are no images of a ",
                "category are ignored: ", names, dataset.ignored.size() > kShown ? ", ..." : "");
}

}  // namespace

std::string exif_note(const std::string& first, int orientation, Index turned, Index total, const std::string& how) {
  return joined(turned, " of ", total, total == 1 ? " image has" : " images have",
                " an EXIF orientation other than 1, which is ignored (", first, ": ", orientation, "); ", how,
                " turns them as viewers do");
}

std::vector<std::string> dataset_notes(const ViewDataset& dataset, Parallel& parallel) {
  std::vector<std::string> notes;
  if (!dataset.ignored.empty()) notes.push_back(ignored_note(dataset));
  if (dataset.exif_orientation == ExifOrientation::obey) return notes;
  std::vector<int> orientations(dataset.views.size(), 1);
  parallel.for_chunks(static_cast<Index>(dataset.views.size()), 16, [&](Index begin, Index end, int) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      orientations[i] = read_exif_orientation(dataset.root / dataset.views[i].path);
  });
  const auto is_turned = [](int orientation) { return orientation != 1; };
  const auto first = std::find_if(orientations.begin(), orientations.end(), is_turned);
  if (first == orientations.end()) return notes;
  notes.push_back(exif_note(dataset.views[static_cast<std::size_t>(first - orientations.begin())].path, *first,
                            std::count_if(orientations.begin(), orientations.end(), is_turned),
                            static_cast<Index>(orientations.size()), "exif_orientation obey"));
  return notes;
}

}  // namespace svnet::io
