#include <type_traits>

#include "base/text.h"
#include "io/hdf5/datatype.h"
#include "io/hdf5/hdf5_file.h"
#include "io/hdf5/open_file.h"

namespace svnet::io {
namespace {

using hdf5::File;
using hdf5::Handle;
using hdf5::Quiet;

/// Little endian, whatever the machine.
template <class T>
Handle file_type() {
  if constexpr (std::is_same_v<T, float>) return Handle(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
  if constexpr (std::is_same_v<T, double>) return Handle(H5Tcopy(H5T_IEEE_F64LE), H5Tclose);
  if constexpr (std::is_same_v<T, std::int64_t>) return Handle(H5Tcopy(H5T_STD_I64LE), H5Tclose);
  if constexpr (std::is_same_v<T, std::uint64_t>) return Handle(H5Tcopy(H5T_STD_U64LE), H5Tclose);
  if constexpr (std::is_same_v<T, std::string>) {
    Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(text.id(), H5T_VARIABLE);
    H5Tset_cset(text.id(), H5T_CSET_UTF8);
    return text;
  }
}

/// The type of the values in memory, as the library takes them: strings as pointers.
template <class T>
Handle memory_type() {
  const Handle type = file_type<T>();
  return Handle(H5Tget_native_type(type.id(), H5T_DIR_DEFAULT), H5Tclose);
}

/// The values as the library takes them. Throws Error for strings that cannot be stored.
template <class T>
std::span<const T> library_values(const File&, const std::string&, std::span<const T> values) {
  return values;
}
std::vector<const char*> library_values(const File& file, const std::string& where,
                                        std::span<const std::string> values) {
  std::vector<const char*> pointers;
  for (const std::string& text : values) {
    if (!is_plain_utf8(text))
      file.fail_at(where, "'", printable(text), "' is not UTF-8 (or contains NUL) and cannot be stored; rename it");
    pointers.push_back(text.c_str());
  }
  return pointers;
}

Handle dataspace(const std::vector<Index>& shape) {
  if (shape.empty()) return Handle(H5Screate(H5S_SCALAR), H5Sclose);
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return Handle(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
}

/// Creation properties without time stamps, so that the same calls give the same bytes.
Handle without_times(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.id(), false);
  return properties;
}

/// Opens the group at the path, and creates the groups of it that are missing.
Handle open_or_create_group(const File& file, std::span<const std::string> parts) {
  const Handle creation = without_times(H5P_GROUP_CREATE);
  Handle current(H5Gopen2(file.file.id(), "/", H5P_DEFAULT), H5Gclose);
  for (const std::string& part : parts) {
    const bool exists = H5Lexists(current.id(), part.c_str(), H5P_DEFAULT) > 0;
    current = exists
                  ? Handle(H5Gopen2(current.id(), part.c_str(), H5P_DEFAULT), H5Gclose)
                  : Handle(H5Gcreate2(current.id(), part.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose);
    file.done(current.id(), "group '" + printable(part) + "'", "cannot be written");
  }
  return current;
}

template <class T>
void write_attribute(const File& file, const std::string& object, const std::string& name,
                     const std::vector<Index>& shape, std::span<const T> values) {
  const std::string where = hdf5::attribute_place(object, name);
  const Handle parent = file.object(object), space = dataspace(shape), type = file_type<T>(), memory = memory_type<T>();
  const auto stored = library_values(file, where, values);
  Handle attribute(H5Acreate2(parent.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  file.done(attribute.id(), where, "cannot be written");
  if (!values.empty()) file.done(H5Awrite(attribute.id(), memory.id(), stored.data()), where, "cannot be written");
  file.done(attribute.reset() ? 0 : -1, where, "cannot be written");
}

}  // namespace

void Hdf5File::create_group(const std::string& group) {
  const Quiet quiet;
  open_or_create_group(state_->here, hdf5::path_parts(group));
}

template <class T>
void Hdf5File::write(const std::string& dataset, const std::vector<Index>& shape, std::span<const T> values) {
  const Quiet quiet;
  const std::string where = "dataset " + hdf5::object_place(dataset);
  Index count = 1;
  for (const Index extent : shape) count *= extent;
  check(static_cast<std::size_t>(count) == values.size(), state_->here.name, ": ", where, ": ", values.size(),
        " values given for a shape of ", count);
  const std::vector<std::string> parts = hdf5::path_parts(dataset);
  check(!parts.empty(), state_->here.name, ": ", where, ": a dataset needs a name");
  const Handle parent = open_or_create_group(state_->here, std::span(parts).first(parts.size() - 1));
  const Handle space = dataspace(shape), type = file_type<T>(), memory = memory_type<T>();
  const Handle creation = without_times(H5P_DATASET_CREATE);
  const auto stored = library_values(state_->here, where, values);
  Handle handle(
      H5Dcreate2(parent.id(), parts.back().c_str(), type.id(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose);
  state_->here.done(handle.id(), where, "cannot be written");
  if (!values.empty())
    state_->here.done(H5Dwrite(handle.id(), memory.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data()), where,
                      "cannot be written");
  // The library keeps the values of small datasets until they are closed, and says only then that they were not
  // written.
  state_->here.done(handle.reset() ? 0 : -1, where, "cannot be written");
}

template void Hdf5File::write(const std::string&, const std::vector<Index>&, std::span<const float>);
template void Hdf5File::write(const std::string&, const std::vector<Index>&, std::span<const double>);
template void Hdf5File::write(const std::string&, const std::vector<Index>&, std::span<const std::int64_t>);
template void Hdf5File::write(const std::string&, const std::vector<Index>&, std::span<const std::uint64_t>);
template void Hdf5File::write(const std::string&, const std::vector<Index>&, std::span<const std::string>);

void Hdf5File::write_text_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Quiet quiet;
  write_attribute<std::string>(state_->here, object, name, {}, std::span(&value, 1));
}

void Hdf5File::write_text_list_attribute(const std::string& object, const std::string& name,
                                         std::span<const std::string> values) {
  const Quiet quiet;
  write_attribute(state_->here, object, name, {static_cast<Index>(values.size())}, values);
}

template <class T>
void Hdf5File::write_number_attribute(const std::string& object, const std::string& name, T value) {
  const Quiet quiet;
  write_attribute<T>(state_->here, object, name, {}, std::span<const T>(&value, 1));
}

template void Hdf5File::write_number_attribute(const std::string&, const std::string&, double);
template void Hdf5File::write_number_attribute(const std::string&, const std::string&, std::int64_t);
template void Hdf5File::write_number_attribute(const std::string&, const std::string&, std::uint64_t);

}  // namespace svnet::io
