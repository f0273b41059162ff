#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"

namespace svnet {

/// An image in a square cell, at its centre, with a line of text below the cell.
struct SheetCell {
  Image image;
  std::string caption{};
};

/// Cells side by side, with a title above the first one.
struct SheetGroup {
  std::vector<SheetCell> cells;
  std::string title{};
};

/// Groups side by side, with a label at their left.
struct SheetLine {
  std::vector<SheetGroup> groups;
  std::string label{};
};

/// Lengths in pixels.
struct SheetLayout {
  Index cell;        ///< side of a cell; a larger or smaller image is resized to fit
  Index gap;         ///< after each cell
  Index margin;      ///< around the sheet, after each group and after each line
  Index text;        ///< height of the titles, and of the captions; 0 if there are none
  double font_size;  ///< relative to OpenCV's FONT_HERSHEY_SIMPLEX
};

/// Images and texts on white. The widest line sets the width.
Image contact_sheet(std::span<const SheetLine> lines, const SheetLayout& layout);

/// A group in a frame.
struct FramedGroup {
  SheetGroup group;
  std::array<std::uint8_t, 3> colour{};  ///< of the frame: red, green, blue
};

/// Groups one below the other on white, each in a frame with its title above. Cells wrap after `columns`. Captions that
/// are wider than a cell are shortened by fitted_text.
Image framed_sheet(std::span<const FramedGroup> groups, Index columns, const SheetLayout& layout);

/// The text as far as OpenCV's font can show it in that width, in pixels: other characters than those of ASCII become
/// '?', and of what is too long, the middle becomes "..".
std::string fitted_text(const std::string& text, Index width, double font_size);

/// The image, as large as fits into a square of that side.
Image resized_to_fit(const Image& image, Index side);

}  // namespace svnet
