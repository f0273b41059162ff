#pragma once
#include "frame/grid.h"

namespace svnet::frame {

/// Otsu's threshold ("A threshold selection method from gray-level histograms", 1979) of the values >= 0 of the
/// inscribed circle's cells, from a histogram of 256 bins. Values above the 95th percentile count as that: otherwise a
/// bright part of an object would be told from its dark part, and not the object from the table. 0 if all are 0.
double otsu_threshold(const Grid<double>& values);

}  // namespace svnet::frame
