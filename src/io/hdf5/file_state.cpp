#include "io/hdf5/file_state.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <unistd.h>

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

void File::look_up_layout() {
  const Handle creation(H5Fget_create_plist(file.id()), H5Pclose);
  hsize_t user_block = 0;
  std::size_t address_size = 0, length_size = 0;
  void* handle = nullptr;
  const bool known = H5Pget_userblock(creation.id(), &user_block) >= 0 &&
                     H5Pget_sizes(creation.id(), &address_size, &length_size) >= 0 &&
                     H5Fget_vfd_handle(file.id(), H5P_DEFAULT, &handle) >= 0 && handle;
  if (!known) fail(name, ": cannot be read: ", reason());
  check(address_size == 8 && length_size == 8, name, ": has addresses of ", address_size, " and lengths of ",
        length_size, " bytes, only 8 are supported");
  base = user_block;
  descriptor = *static_cast<const int*>(handle);
}

std::vector<char> File::bytes(std::uint64_t address, std::uint64_t count, const std::string& where) const {
  if (address > size || base > size - address || count > size - address - base)
    fail_at(where, "lies outside the file in part; the file is damaged");
  std::vector<char> result(count);
  for (std::uint64_t done = 0; done < count;) {
    const ssize_t got =
        ::pread(descriptor, result.data() + done, count - done, static_cast<off_t>(base + address + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      fail_at(where, "cannot be read: ", got < 0 ? std::generic_category().message(errno) : "the file ends");
    done += static_cast<std::uint64_t>(got);
  }
  return result;
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
