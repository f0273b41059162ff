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

TEST_CASE("a framed sheet shows each group in a frame of its colour, and wraps cells") {
  const Image red{1, 1, {255, 0, 0}};
  const std::vector<FramedGroup> groups{{.group = {.cells = {{red}, {red}, {red}}}, .colour = {0, 0, 200}},
                                        {.group = {.cells = {{red}}}, .colour = {0, 200, 0}}};
  const Image sheet = framed_sheet(groups, 2, {.cell = 20, .gap = 4, .margin = 10, .text = 12, .font_size = 0.4});
  CHECK(sheet.width == 2 * 24 + 4 + 20);
  CHECK(sheet.height == 10 + 2 * (12 + 4 + 10) + 3 * 36);
  const auto pixel = [&](Index y, Index x) {
    const auto at = static_cast<std::size_t>(3 * (y * sheet.width + x));
    return std::vector<int>{sheet.rgb[at], sheet.rgb[at + 1], sheet.rgb[at + 2]};
  };
  const std::vector<int> kRed{255, 0, 0}, kWhite{255, 255, 255};
  CHECK(pixel(50, 10) == std::vector<int>{0, 0, 200});
  CHECK(pixel(130, 10) == std::vector<int>{0, 200, 0});
  CHECK(pixel(36, 24) == kRed);
  CHECK(pixel(36, 48) == kRed);
  CHECK(pixel(72, 24) == kRed);  // wrapped
  CHECK(pixel(72, 48) == kWhite);
}

TEST_CASE("text is cut to a width, and characters without a picture become '?'") {
  CHECK(fitted_text("mug 12", 200, 0.4) == "mug 12");
  CHECK(fitted_text("Käse\n", 200, 0.4) == "K?se ");
  const std::string cut = fitted_text("a very long name of a picture", 80, 0.4);
  CHECK(cut.size() < 16);
  CHECK_THAT(cut, Catch::StartsWith("a ve") && Catch::Contains("..") && Catch::EndsWith("ure"));
  CHECK(fitted_text("mug", 1, 0.4) == "..");
}
