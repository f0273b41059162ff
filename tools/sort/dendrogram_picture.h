#pragma once
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "sort/grouping.h"

namespace svnet {

constexpr Index kThumbnail_px = 112;

/// An object as pictures show it.
struct ObjectLook {
  std::string name;
  Image thumbnail;  ///< fits into a square of kThumbnail_px
};

/// A thumbnail of an object's pictures: the picture, or up to four of them, evenly chosen, in two columns. `pictures`
/// is not empty.
Image object_thumbnail(std::span<const Image> pictures);

/// The groups one below the other, each in a frame of its colour.
Image groups_sheet(const Grouping& grouping, std::span<const ObjectLook> looks);

/// The dendrogram from left to right: a line per object with its thumbnail and name, merges at their heights, the
/// groups in the colours of the sheet with their numbers, and the cut as a dashed line.
Image dendrogram_picture(const Grouping& grouping, std::span<const ObjectLook> looks);

}  // namespace svnet
