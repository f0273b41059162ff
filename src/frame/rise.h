#pragma once
#include "frame/grid.h"
#include "image/depth_image.h"

namespace svnet::frame {

/// How far the cells of a top view's depth image stand above the table.
struct Rise {
  Grid<double> metres;  // along the camera's axis; NaN: not measured
  double table_m = 0;   // from the camera to the table's plane in the middle of the image
  double noise_m = 0;   // the standard deviation of a cell on the table
};

/// The table is the plane fitted to the ring (table_plane.h). Its inverse depth is an affine function of the pixel for
/// every pinhole camera, also a tilted one, so no intrinsics are needed. Throws Error for an empty image, one without
/// height x width values, and if less than a tenth of the ring was measured.
Rise rise_of(const DepthImage&);

}  // namespace svnet::frame
