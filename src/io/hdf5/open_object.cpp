// Objects of a file, opened only after their links and storage were checked.
#include <algorithm>

#include "io/hdf5/file_state.h"

namespace svnet::io::hdf5 {
namespace {

bool is_refused_filter(H5Z_filter_t filter) { return filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE; }

/// Throws Error unless the values are stored in this file, with known filters.
void check_storage(const File& file, const Handle& creation, const std::string& where) {
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  if (layout == H5D_VIRTUAL) file.fail_at(where, "is a virtual dataset; these are not followed, store the values");
  if (H5Pget_external_count(creation.id()) != 0)
    file.fail_at(where, "has its values in another file; these are not followed, store the values");
  const int filters = file.done(H5Pget_nfilters(creation.id()), where, "its filters cannot be read");
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0, config = 0;
    std::size_t count = 0;
    char name[64] = "";
    const H5Z_filter_t filter =
        H5Pget_filter2(creation.id(), static_cast<unsigned>(i), &flags, &count, nullptr, sizeof name, name, &config);
    if (is_refused_filter(filter))
      file.fail_at(where, "is stored through the filter number ", filter,
                   ", which is not supported; use gzip, shuffle or none");
  }
}

/// Throws Error for chunks that the file is too small to fill, because the library allocates a whole chunk.
void check_chunk(const File& file, const Handle& creation, std::size_t element, const std::string& where) {
  hsize_t dims[H5S_MAX_RANK];
  const int rank = file.done(H5Pget_chunk(creation.id(), H5S_MAX_RANK, dims), where, "its chunks cannot be read");
  const std::uint64_t largest = std::min(kLargestCompression * file.size, largest_decoded(file.size));
  std::uint64_t bytes = element;
  for (int i = 0; i < rank; ++i) {
    if (dims[i] == 0 || bytes > largest / dims[i])
      file.fail_at(where, "declares chunks that a file of ", file.size, " bytes cannot hold");
    bytes *= dims[i];
  }
}

void check_size(const File& file, const Handle& dataset, const Handle& creation, const std::string& where) {
  const Handle space(H5Dget_space(dataset.id()), H5Sclose), type(H5Dget_type(dataset.id()), H5Tclose);
  file.done(space.id(), where, "its shape cannot be read");
  file.done(type.id(), where, "its type cannot be read");
  const std::uint64_t element = std::max<std::uint64_t>(H5Tget_size(type.id()), 1);
  const std::uint64_t count = file.extent(space.id(), where).count;
  if (count > kLargestBytes / element)
    file.fail_at(where, "declares ", count, " values of ", element, " bytes, more than the limit of ", kLargestBytes,
                 " bytes");
  const bool chunked = H5Pget_layout(creation.id()) == H5D_CHUNKED;
  if (chunked) check_chunk(file, creation, element, where);
  const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(dataset.id()), file.size);
  const bool filtered = H5Pget_nfilters(creation.id()) > 0;
  if (count * element > stored * (filtered ? kLargestCompression : 1))
    file.fail_at(where, "declares ", count * element, " bytes but only ", stored,
                 " are stored; the file is incomplete or damaged");
  if (count * element > largest_decoded(file.size))
    file.fail_at(where, "declares ", count * element, " bytes, more than the limit of ", largest_decoded(file.size),
                 " for what a file of ", file.size, " bytes is decoded to");
}

}  // namespace

Handle File::object(const std::string& path) const {
  const std::string where = object_place(path);
  Handle current(H5Oopen(file.id(), "/", H5P_DEFAULT), H5Oclose);
  done(current.id(), where, "cannot be opened");
  for (const std::string& part : path_parts(path)) {
    if (H5Iget_type(current.id()) != H5I_GROUP) fail_at(where, "is missing");
    if (done(H5Lexists(current.id(), part.c_str(), H5P_DEFAULT), where, "cannot be looked up") == 0)
      fail_at(where, "is missing");
    H5L_info_t link;
    done(H5Lget_info(current.id(), part.c_str(), &link, H5P_DEFAULT), where, "cannot be looked up");
    if (link.type != H5L_TYPE_HARD)
      fail_at(where, "is reached through a soft or external link; these are not followed, store the object itself");
    Handle next(H5Oopen(current.id(), part.c_str(), H5P_DEFAULT), H5Oclose);
    done(next.id(), where, "cannot be opened");
    current = std::move(next);
  }
  return current;
}

Handle File::group(const std::string& path) const {
  Handle handle = object(path);
  if (H5Iget_type(handle.id()) != H5I_GROUP) fail_at(object_place(path), "is not a group");
  return handle;
}

Handle File::dataset(const std::string& path) const {
  const std::string where = "dataset " + object_place(path);
  Handle handle = object(path);
  if (H5Iget_type(handle.id()) != H5I_DATASET) fail_at(object_place(path), "is not a dataset");
  const Handle creation(H5Dget_create_plist(handle.id()), H5Pclose);
  done(creation.id(), where, "its layout cannot be read");
  check_storage(*this, creation, where);
  check_size(*this, handle, creation, where);
  return handle;
}

Handle File::attribute(const std::string& path, const std::string& attribute_name) const {
  const std::string where = attribute_place(path, attribute_name);
  const Handle parent = object(path);
  if (done(H5Aexists(parent.id(), attribute_name.c_str()), where, "cannot be looked up") == 0)
    fail_at(where, "is missing");
  Handle handle(H5Aopen(parent.id(), attribute_name.c_str(), H5P_DEFAULT), H5Aclose);
  done(handle.id(), where, "cannot be opened");
  return handle;
}

}  // namespace svnet::io::hdf5
