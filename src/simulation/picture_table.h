#pragma once
#include <string>
#include <vector>

#include "image/image.h"

namespace svnet {

/// One row of a table: its label, and its pictures from the left.
struct PictureRow {
  std::string label;
  std::vector<Image> pictures;
};

/// The picture scaled to the largest size that fits into a square of side_px.
Image resized_to_fit(const Image& picture, Index side_px);

/// A table of pictures on white, each scaled to fit a square of cell_px.
Image picture_table(const std::vector<PictureRow>& rows, Index cell_px);

}  // namespace svnet
