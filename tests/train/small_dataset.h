#pragma once
#include <string>

#include "io/images/image_file.h"
#include "temporary_folder.h"

namespace svnet {

/// Images in the layout of a dataset: 4 categories of 2 objects with one pose, 4 views of 24x24 pixels each. Each
/// category has its own colour, which is clear in the views at 45 degrees and faint in the others.
inline void write_small_dataset(const std::filesystem::path& root) {
  const std::string categories[] = {"ball", "cone", "cube", "ring"};
  for (int category = 0; category < 4; ++category)
    for (int object = 0; object < 2; ++object) {
      const auto folder = root / categories[category] / std::to_string(object) / "1";
      std::filesystem::create_directories(folder);
      for (const char* view : {"90_90", "45_0", "45_90", "75_180"}) {
        Image image{24, 24, {}};
        const bool telling = std::string(view).starts_with("45");
        for (int p = 0; p < 24 * 24; ++p)
          for (int channel = 0; channel < 3; ++channel) {
            const int texture = (p * (7 + channel) + 31 * object + p / 24 * 5) % 60;
            image.rgb.push_back(
                static_cast<std::uint8_t>(texture + (channel == category % 3 ? (telling ? 150 : 30) : category * 9)));
          }
        io::write_png(folder / (std::string(view) + ".png"), image);
      }
    }
}

}  // namespace svnet
