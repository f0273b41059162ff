#include "io/hdf5/answer.h"

#include <algorithm>

#include "base/text.h"
#include "io/hdf5/blocks.h"
#include "io/hdf5/convert.h"

namespace svnet::io::hdf5 {
namespace {

bool has(const File& file, const std::string& object) {
  const std::string where = object_place(object);
  std::string so_far;
  for (const std::string& part : path_parts(object)) {
    const Handle parent = file.object(so_far);
    if (H5Iget_type(parent.id()) != H5I_GROUP) return false;
    if (file.done(H5Lexists(parent.id(), part.c_str(), H5P_DEFAULT), where, "cannot be looked up") == 0) return false;
    so_far += "/" + part;
  }
  return true;
}

bool is_group(const File& file, const std::string& object) {
  return has(file, object) && H5Iget_type(file.object(object).id()) == H5I_GROUP;
}

bool has_attribute(const File& file, const std::string& object, const std::string& name) {
  const Handle handle = file.object(object);
  return file.done(H5Aexists(handle.id(), name.c_str()), attribute_place(object, name), "cannot be looked up") > 0;
}

herr_t append_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (...) {
    return -1;
  }
}

/// In natural order.
std::vector<std::string> members(const File& file, const std::string& group) {
  const Handle handle = file.group(group);
  std::vector<std::string> names;
  file.done(H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, append_name, &names), object_place(group),
            "its members cannot be listed");
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

void put_shape(const Extent& extent, Sink& sink) {
  sink.shape(std::vector<std::uint64_t>(extent.shape.begin(), extent.shape.end()));
}

void put_values(const File& file, As as, const Source& source, Sink& sink) {
  switch (as) {
    case As::real32:
      return read_numbers<float>(file, source, sink);
    case As::real64:
      return read_numbers<double>(file, source, sink);
    case As::signed64:
      return read_numbers<std::int64_t>(file, source, sink);
    case As::unsigned64:
      return read_numbers<std::uint64_t>(file, source, sink);
    case As::text:
      return read_texts(file, source, sink);
  }
}

void put_shape_of(const File& file, const std::string& dataset, Sink& sink) {
  const Handle handle = file.dataset(dataset);
  const Handle space(H5Dget_space(handle.id()), H5Sclose);
  put_shape(file.extent(space.id(), "dataset " + object_place(dataset)), sink);
}

void put_dataset(const File& file, const Request& request, Sink& sink) {
  const std::string where = "dataset " + object_place(request.object);
  const Handle handle = file.dataset(request.object);
  const Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
  file.done(type.id(), where, "its type cannot be read");
  const Extent extent = file.extent(space.id(), where);
  put_shape(extent, sink);
  const auto read_blocks = [&](std::uint64_t most, const TakeBlock& take) {
    read_dataset_blocks(file, handle.id(), extent, where, most, take);
  };
  put_values(file, request.as, {where, type.id(), extent.count, read_blocks}, sink);
}

void put_attribute(const File& file, const Request& request, Sink& sink) {
  const std::string where = attribute_place(request.object, request.attribute);
  const Handle handle = file.attribute(request.object, request.attribute);
  const Handle type(H5Aget_type(handle.id()), H5Tclose), space(H5Aget_space(handle.id()), H5Sclose);
  file.done(type.id(), where, "its type cannot be read");
  file.done(space.id(), where, "its shape cannot be read");
  const Extent extent = file.extent(space.id(), where);
  const std::uint64_t element = std::max<std::uint64_t>(H5Tget_size(type.id()), 1);
  if (extent.count > file.size / element)
    file.fail_at(where, "declares ", extent.count, " values in a file of ", file.size, " bytes");
  if (request.ask == Ask::attribute && extent.count != 1)
    file.fail_at(where, "holds ", extent.count, " values, expected one");
  put_shape(extent, sink);
  const auto read_blocks = [&](std::uint64_t, const TakeBlock& take) {
    if (extent.count > 0)
      take(extent.count, [&](hid_t memory, hid_t, void* values) { return H5Aread(handle.id(), memory, values); });
  };
  put_values(file, request.as, {where, type.id(), extent.count, read_blocks}, sink);
}

}  // namespace

void answer(const File& file, const Request& request, Sink& sink) {
  switch (request.ask) {
    case Ask::has:
      return sink.truth(has(file, request.object));
    case Ask::is_group:
      return sink.truth(is_group(file, request.object));
    case Ask::has_attribute:
      return sink.truth(has_attribute(file, request.object, request.attribute));
    case Ask::members:
      return sink.texts(members(file, request.object));
    case Ask::shape:
      return put_shape_of(file, request.object, sink);
    case Ask::dataset:
      return put_dataset(file, request, sink);
    case Ask::attribute:
    case Ask::list:
      return put_attribute(file, request, sink);
  }
}

}  // namespace svnet::io::hdf5
