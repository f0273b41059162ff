#include <type_traits>

#include "io/hdf5/convert.h"
#include "io/hdf5/file_state.h"
#include "io/hdf5/hdf5_file.h"

namespace svnet::io {
namespace {

using hdf5::Extent;
using hdf5::File;
using hdf5::Handle;
using hdf5::Quiet;

std::string dataset_place(const std::string& dataset) { return "dataset " + hdf5::object_place(dataset); }

struct Attribute {
  Handle handle, type, space;
  std::string where;
  std::uint64_t count;
};

Attribute open_attribute(const File& file, const std::string& object, const std::string& name) {
  Attribute attribute;
  attribute.where = hdf5::attribute_place(object, name);
  attribute.handle = file.attribute(object, name);
  attribute.type = Handle(H5Aget_type(attribute.handle.id()), H5Tclose);
  attribute.space = Handle(H5Aget_space(attribute.handle.id()), H5Sclose);
  file.done(attribute.type.id(), attribute.where, "its type cannot be read");
  file.done(attribute.space.id(), attribute.where, "its shape cannot be read");
  attribute.count = file.extent(attribute.space.id(), attribute.where).count;
  if (attribute.count > file.size)
    file.fail_at(attribute.where, "declares ", attribute.count, " values in a file of ", file.size, " bytes");
  return attribute;
}

std::vector<std::string> attribute_texts(const File& file, const Attribute& attribute) {
  const auto read = [&](hid_t type, void* values) { return H5Aread(attribute.handle.id(), type, values); };
  return hdf5::read_texts(file, attribute.where, attribute.type.id(), attribute.count, read);
}

void check_single(const File& file, const Attribute& attribute) {
  if (attribute.count != 1) file.fail_at(attribute.where, "holds ", attribute.count, " values, expected one");
}

}  // namespace

std::vector<Index> Hdf5File::shape(const std::string& dataset) const {
  const Quiet quiet;
  const Handle handle = state_->dataset(dataset);
  const Handle space(H5Dget_space(handle.id()), H5Sclose);
  return state_->extent(space.id(), dataset_place(dataset)).shape;
}

template <class T>
Hdf5Array<T> Hdf5File::read(const std::string& dataset) const {
  const Quiet quiet;
  const std::string where = dataset_place(dataset);
  const Handle handle = state_->dataset(dataset);
  const Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
  state_->done(type.id(), where, "its type cannot be read");
  Extent extent = state_->extent(space.id(), where);
  const auto read = [&](hid_t memory_type, void* values) {
    return H5Dread(handle.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  };
  if constexpr (std::is_same_v<T, std::string>) {
    return {std::move(extent.shape), hdf5::read_texts(*state_, where, type.id(), extent.count, read)};
  } else {
    return {std::move(extent.shape), hdf5::read_numbers<T>(*state_, where, type.id(), extent.count, read)};
  }
}

template Hdf5Array<float> Hdf5File::read(const std::string&) const;
template Hdf5Array<double> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::int64_t> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::uint64_t> Hdf5File::read(const std::string&) const;
template Hdf5Array<std::string> Hdf5File::read(const std::string&) const;

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  const Handle handle = state_->object(object);
  const htri_t exists = H5Aexists(handle.id(), name.c_str());
  return state_->done(exists, hdf5::attribute_place(object, name), "cannot be looked up") > 0;
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  const Attribute attribute = open_attribute(*state_, object, name);
  check_single(*state_, attribute);
  return attribute_texts(*state_, attribute).front();
}

std::vector<std::string> Hdf5File::text_list_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  return attribute_texts(*state_, open_attribute(*state_, object, name));
}

template <class T>
T Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  const Attribute attribute = open_attribute(*state_, object, name);
  check_single(*state_, attribute);
  const auto read = [&](hid_t type, void* values) { return H5Aread(attribute.handle.id(), type, values); };
  return hdf5::read_numbers<T>(*state_, attribute.where, attribute.type.id(), 1, read).front();
}

template double Hdf5File::number_attribute(const std::string&, const std::string&) const;
template std::int64_t Hdf5File::number_attribute(const std::string&, const std::string&) const;
template std::uint64_t Hdf5File::number_attribute(const std::string&, const std::string&) const;

}  // namespace svnet::io
