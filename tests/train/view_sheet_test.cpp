#include "train/view_sheet.h"

#include <catch2/catch.hpp>

#include "io/views/dataset_folder.h"
#include "small_dataset.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::train;

TEST_CASE("a contact sheet shows the views that its selectors choose") {
  const TemporaryFolder folder;
  write_small_dataset(folder.path());
  // A view of one colour, to be found on the sheet.
  write_png(folder.path() / "cone/1/1/45_90.png", {24, 24, [] {
                                                     std::vector<std::uint8_t> red(24 * 24 * 3, 0);
                                                     for (std::size_t i = 0; i < red.size(); i += 3) red[i] = 255;
                                                     return red;
                                                   }()});
  const ViewDataset dataset = read_view_dataset(folder.path());
  const std::vector<Index> poses = sheet_poses(dataset, {false, true, false, true});
  REQUIRE(poses == std::vector<Index>{2, 3, 6, 7});  // 2 objects of cone, 2 of ring
  std::vector<double> scores(dataset.views.size(), 0.0);
  for (std::size_t v = 0; v < dataset.views.size(); ++v) scores[v] = dataset.views[v].path == "cone/1/1/45_90.png";
  const std::vector<Selector> selectors{{"top", top_views(dataset)}, {"best", best_views(dataset, scores)}};
  const Image sheet = view_sheet(dataset, poses, selectors);
  // Two rows of two groups of two images.
  CHECK(sheet.width == 20 + 2 * (2 * 116 + 20));
  CHECK(sheet.height == 20 + 2 * (112 + 36 + 20));
  std::vector<std::pair<Index, Index>> red;
  Index dark_rows = 0;  // of text above the first group
  for (Index y = 0; y < sheet.height; ++y)
    for (Index x = 0; x < sheet.width; ++x) {
      const std::uint8_t* p = sheet.rgb.data() + (y * sheet.width + x) * 3;
      if (p[0] == 255 && p[1] == 0 && p[2] == 0) red.emplace_back(x, y);
      dark_rows += y < 38 && p[0] < 100;
    }
  REQUIRE(red.size() == 112 * 112);  // cone/1/1 is the second group, its best view the second image
  CHECK(red.front() == std::pair<Index, Index>{20 + 2 * 116 + 20 + 116, 38});
  CHECK(red.back() == std::pair<Index, Index>{20 + 2 * 116 + 20 + 116 + 111, 38 + 111});
  CHECK(dark_rows > 20);
}
