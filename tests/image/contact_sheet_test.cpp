#include "image/contact_sheet.h"

#include <catch2/catch.hpp>

using namespace svnet;

TEST_CASE("a contact sheet shows each image in its cell, next to the label of its row") {
  const Image red{2, 2, {255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0}};
  const Image wide{1, 2, {0, 0, 255, 0, 0, 255}};
  const std::vector<SheetLine> lines{{.groups = {{.cells = {{red}, {wide}}}}, .label = "a"},
                                     {.groups = {{.cells = {{red}}}}, .label = "longer"}};
  const Image sheet = contact_sheet(lines, {.cell = 40, .gap = 2, .margin = 2, .text = 0, .font_size = 0.45});
  CHECK(sheet.height == 2 * 42 + 2);
  const auto pixel = [&](Index y, Index from_right) {
    const auto at = static_cast<std::size_t>(3 * (y * sheet.width + sheet.width - from_right));
    return std::vector<int>{sheet.rgb[at], sheet.rgb[at + 1], sheet.rgb[at + 2]};
  };
  CHECK(pixel(20, 60) == std::vector<int>{255, 0, 0});
  CHECK(pixel(20, 20) == std::vector<int>{0, 0, 255});
  CHECK(pixel(5, 20) == std::vector<int>{255, 255, 255});  // above the wide image, which keeps its proportions
  CHECK(pixel(62, 60) == std::vector<int>{255, 0, 0});
  CHECK(pixel(62, 20) == std::vector<int>{255, 255, 255});
  int dark = 0;
  for (Index y = 0; y < sheet.height; ++y)
    for (Index x = 0; x + 86 < sheet.width; ++x)
      dark += sheet.rgb[static_cast<std::size_t>(3 * (y * sheet.width + x))] < 64;
  CHECK(dark > 20);  // the labels
}
