#pragma once
#include "frame/object_axis.h"

namespace svnet::frame {

/// The focal length of the paper's camera, and of svnet-render's views, in sides of the image: fx / width.
inline constexpr double kPaperFocal_sides = 1.25;

/// How an object stands above the table. All but `measured` are relative to the object's length, so a large object has
/// the numbers of a small one of its shape.
struct Heights {
  bool are_known = false;  ///< else all are 0
  double measured = 0;     ///< the share of the silhouette's cells that have depth
  double height = 0;       ///< the 98th percentile of the rise above the table / length
  double width = 0;        ///< width / length
  double mean_height = 0;  ///< mean rise / length
  double flatness = 0;     ///< 1 - (90th - 10th percentile of the rise) / 98th: 1 for a level top, near 0 for a cone
  double footprint = 0;    ///< area of the silhouette / length²
  double volume = 0;       ///< mean_height · footprint: volume between the table and the visible surface / length³
};

/// From the depth of a top view, and the silhouette and axis of the same view. Of the camera only the focal length is
/// needed, in sides of the image's centred square: fx / min(height, width). It turns the length of the silhouette
/// into metres at the depth of half the object's height. Heights are not known if the axis is unclear, or if less than
/// a quarter of the silhouette was measured. Throws Error as rise_of (rise.h), and unless focal_sides is positive.
Heights heights_of(const DepthImage& top_depth, const Silhouette&, const ObjectAxis&,
                   double focal_sides = kPaperFocal_sides);

}  // namespace svnet::frame
