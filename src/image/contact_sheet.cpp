#include "image/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "base/text.h"
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

std::string fitted_text(const std::string& text, Index width, double font_size) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) != 0x80) shown += byte < 0x80 ? printable(c) : '?';  // one '?' per character of UTF-8
  }
  const auto fits = [&](const std::string& part) {
    return cv::getTextSize(part, kFont, font_size, 1, nullptr).width <= static_cast<int>(width);
  };
  if (fits(shown)) return shown;
  const auto cut_to = [&](std::size_t kept) {
    const std::size_t end = kept / 2;
    return shown.substr(0, kept - end) + ".." + shown.substr(shown.size() - end);
  };
  std::size_t kept = shown.size() - 1;
  while (kept > 0 && !fits(cut_to(kept))) --kept;
  return cut_to(kept);
}

Image framed_sheet(std::span<const FramedGroup> groups, Index columns, const SheetLayout& layout) {
  constexpr Index kFrame = 2;  // pixels
  const Index step_x = layout.cell + layout.gap, step_y = layout.cell + layout.text + layout.gap;
  const auto lines_of = [&](const FramedGroup& framed) {
    return (static_cast<Index>(framed.group.cells.size()) + columns - 1) / columns;
  };
  Index widest = 1, height = layout.margin;
  for (const FramedGroup& framed : groups) {
    widest = std::max(widest, std::min(columns, static_cast<Index>(framed.group.cells.size())));
    height += layout.text + layout.gap + lines_of(framed) * step_y + layout.margin;
  }
  const Index frame_width = widest * step_x + layout.gap;
  Image sheet = white(height, frame_width + 2 * layout.margin);
  cv::Mat3b pixels = matrix_of(sheet);
  Index top = layout.margin;
  for (const FramedGroup& framed : groups) {
    const cv::Scalar colour(framed.colour[0], framed.colour[1], framed.colour[2]);
    const Index frame_height = lines_of(framed) * step_y + layout.gap;
    write_text(pixels, fitted_text(framed.group.title, frame_width, layout.font_size), layout.margin,
               top + layout.text - kTitleRise, layout.font_size);
    top += layout.text;
    const cv::Rect frame(static_cast<int>(layout.margin), static_cast<int>(top), static_cast<int>(frame_width),
                         static_cast<int>(frame_height));
    cv::rectangle(pixels, frame, colour, kFrame);
    for (std::size_t i = 0; i < framed.group.cells.size(); ++i) {
      SheetCell cell = framed.group.cells[i];
      cell.caption = fitted_text(cell.caption, layout.cell, layout.font_size);
      const Index column = static_cast<Index>(i) % columns, line = static_cast<Index>(i) / columns;
      draw_cell(pixels, cell, layout.margin + layout.gap + column * step_x, top + layout.gap + line * step_y, layout);
    }
    top += frame_height + layout.margin;
  }
  return sheet;
}

}  // namespace svnet
