#include "image/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "image/opencv_image.h"

namespace svnet {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr Index kLabelMargin = 8;                                   // on both sides of a label
constexpr Index kLabelRise = 5, kTitleRise = 5, kCaptionDrop = 12;  // of a baseline, from the middle or edge of a cell

Image white(Index height, Index width) {
  return {height, width, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * height * width), 255)};
}

void write_text(cv::Mat3b& sheet, const std::string& text, Index x, Index baseline, double size) {
  cv::putText(sheet, text, {static_cast<int>(x), static_cast<int>(baseline)}, kFont, size, {0, 0, 0}, 1, cv::LINE_AA);
}

/// Where the first cell of a line begins: after the widest label, or after the margin if there are no labels.
Index left_of_cells(std::span<const SheetLine> lines, const SheetLayout& layout) {
  Index widest = 0;
  for (const SheetLine& line : lines)
    if (!line.label.empty())
      widest = std::max<Index>(
          widest, cv::getTextSize(line.label, kFont, layout.font_size, 1, nullptr).width + 2 * kLabelMargin);
  return widest > 0 ? widest : layout.margin;
}

Index width_of(const SheetLine& line, const SheetLayout& layout) {
  Index width = 0;
  for (const SheetGroup& group : line.groups)
    width += static_cast<Index>(group.cells.size()) * (layout.cell + layout.gap) + layout.margin;
  return width;
}

void draw_cell(cv::Mat3b& sheet, const SheetCell& cell, Index x, Index y, const SheetLayout& layout) {
  const Image fitted = resized_to_fit(cell.image, layout.cell);
  const cv::Rect place(static_cast<int>(x + (layout.cell - fitted.width) / 2),
                       static_cast<int>(y + (layout.cell - fitted.height) / 2), static_cast<int>(fitted.width),
                       static_cast<int>(fitted.height));
  matrix_of(fitted).copyTo(sheet(place));
  if (!cell.caption.empty()) write_text(sheet, cell.caption, x, y + layout.cell + kCaptionDrop, layout.font_size);
}

}  // namespace

Image resized_to_fit(const Image& image, Index side) {
  const cv::Mat3b source = matrix_of(image);
  const double fit = static_cast<double>(side) / static_cast<double>(std::max(image.height, image.width));
  const auto fitted = [fit](int length) { return std::max<Index>(1, static_cast<int>(length * fit)); };
  Image result = white(fitted(source.rows), fitted(source.cols));
  cv::Mat3b pixels = matrix_of(result);
  cv::resize(source, pixels, pixels.size(), 0, 0, fit < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result;
}

Image contact_sheet(std::span<const SheetLine> lines, const SheetLayout& layout) {
  const Index left = left_of_cells(lines, layout), height = 2 * layout.text + layout.cell + layout.margin;
  Index widest = 0;
  for (const SheetLine& line : lines) widest = std::max(widest, width_of(line, layout));
  Image sheet = white(layout.margin + static_cast<Index>(lines.size()) * height, left + widest);
  cv::Mat3b pixels = matrix_of(sheet);
  Index y = layout.margin + layout.text;
  for (const SheetLine& line : lines) {
    if (!line.label.empty())
      write_text(pixels, line.label, kLabelMargin, y + layout.cell / 2 + kLabelRise, layout.font_size);
    Index x = left;
    for (const SheetGroup& group : line.groups) {
      if (!group.title.empty()) write_text(pixels, group.title, x, y - kTitleRise, layout.font_size);
      for (const SheetCell& cell : group.cells) {
        draw_cell(pixels, cell, x, y, layout);
        x += layout.cell + layout.gap;
      }
      x += layout.margin;
    }
    y += height;
  }
  return sheet;
}

}  // namespace svnet
