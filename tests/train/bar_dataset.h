#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "frame/top_view.h"
#include "io/images/depth_file.h"
#include "io/images/image_file.h"

namespace svnet {

/// Images in the layout of a dataset: 6 categories of 2 objects with one pose, 7 views each. The top view shows a
/// wedge-shaped bar on a table, at a random angle. A view shows the category's colour as far as it looks across the
/// bar, and else the colour of any category: what is worth seeing depends on the object's axis alone. With
/// `with_depth`, _extra/ holds the depth of the top views.
inline void write_bar_dataset(const std::filesystem::path& root, bool with_depth = false) {
  const std::array<std::string, 6> categories{"awl", "bar", "cue", "fid", "peg", "rod"};
  const std::array<std::array<double, 3>, 6> colours{
      {{200, 20, 20}, {20, 200, 20}, {20, 20, 200}, {180, 180, 20}, {20, 180, 180}, {180, 20, 180}}};
  const std::array<std::array<int, 2>, 6> phi_theta{{{45, 0}, {45, 45}, {45, 90}, {45, 135}, {75, 0}, {75, 90}}};
  std::mt19937 random(5);
  for (std::size_t category = 0; category < categories.size(); ++category)
    for (int object = 0; object < 2; ++object) {
      const auto place = std::filesystem::path(categories[category]) / std::to_string(object) / "1";
      std::filesystem::create_directories(root / place);
      const double angle_deg = static_cast<double>(random() % 360);
      const frame::Shape bar = frame::wedge(1.4, 0.4, angle_deg);
      io::write_png(root / place / "90_90.png",
                    frame::picture_of(bar, {.height = 64, .width = 64, .seed = static_cast<unsigned>(random())}));
      if (with_depth) {
        std::filesystem::create_directories(root / "_extra" / place);
        io::write_depth_png(root / "_extra" / place / "90_90_depth.png",
                            frame::depth_of(bar, [](double, double) { return 0.03; }));
      }
      for (const auto& [phi, theta] : phi_theta) {
        const double across = std::abs(std::sin((theta - angle_deg) * std::numbers::pi / 180));
        const double telling = phi == 45 ? across * across : 0.3;
        const auto& other = colours[random() % colours.size()];
        Image image{24, 24, {}};
        for (int pixel = 0; pixel < 24 * 24; ++pixel)
          for (std::size_t c = 0; c < 3; ++c)
            image.rgb.push_back(static_cast<std::uint8_t>(telling * colours[category][c] + (1 - telling) * other[c] +
                                                          static_cast<double>(random() % 40)));
        io::write_png(root / place / (std::to_string(phi) + "_" + std::to_string(theta) + ".png"), image);
      }
    }
}

}  // namespace svnet
