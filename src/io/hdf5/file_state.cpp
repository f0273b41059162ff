#include "io/hdf5/file_state.h"

#include <algorithm>

#include "base/text.h"

namespace svnet::io::hdf5 {

std::string object_place(const std::string& object) {
  return object.empty() ? "its root" : "'" + printable(object) + "'";
}

std::string attribute_place(const std::string& object, const std::string& name) {
  return "attribute '" + printable(name) + "'" + (object.empty() ? "" : " of '" + printable(object) + "'");
}

std::vector<std::string> path_parts(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (end > begin) parts.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Extent File::extent(hid_t space, const std::string& where) const {
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return {{0}, 0};
  const int rank = done(H5Sget_simple_extent_ndims(space), where, "its shape cannot be read");
  hsize_t dims[H5S_MAX_RANK];
  if (rank > 0) done(H5Sget_simple_extent_dims(space, dims, nullptr), where, "its shape cannot be read");
  Extent extent;
  for (int i = 0; i < rank; ++i) {
    if (dims[i] > kLargestBytes) fail_at(where, "declares a dimension of ", dims[i], ", too large to be true");
    extent.shape.push_back(static_cast<Index>(dims[i]));
  }
  if (std::count(extent.shape.begin(), extent.shape.end(), 0) > 0) return {extent.shape, 0};
  for (int i = 0; i < rank; ++i) {
    if (extent.count > kLargestBytes / dims[i]) fail_at(where, "declares more than ", kLargestBytes, " values");
    extent.count *= dims[i];
  }
  return extent;
}

}  // namespace svnet::io::hdf5
