#pragma once
#include <string>
#include <vector>

#include "image/image.h"

namespace svnet {

/// One line of a contact sheet: its label, and pictures from the left.
struct ContactRow {
  std::string label;
  std::vector<Image> pictures;
};

/// A table of pictures on white, each fitted into a square of cell_px.
Image contact_sheet(const std::vector<ContactRow>& rows, Index cell_px);

}  // namespace svnet
