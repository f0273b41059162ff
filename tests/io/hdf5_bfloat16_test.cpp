#include <catch2/catch.hpp>

#include <hdf5.h>

#include "io/hdf5/hdf5_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;

namespace {

void write_dataset(hid_t file, const char* name, hid_t type, const std::vector<unsigned char>& bytes) {
  const hsize_t count = bytes.size() / 2;
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  H5Dclose(dataset);
  H5Sclose(space);
}

}  // namespace

TEST_CASE("bfloat16 is read, as h5py stores it (2 bytes without a type) and as a float type") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "w.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t opaque = H5Tcreate(H5T_OPAQUE, 2), little = H5Tcopy(H5T_IEEE_F32LE);
  H5Tset_tag(opaque, "");
  H5Tset_fields(little, 15, 7, 8, 0, 7);
  H5Tset_size(little, 2);
  H5Tset_ebias(little, 127);
  const hid_t big = H5Tcopy(little);
  H5Tset_order(big, H5T_ORDER_BE);
  // 1, -2.5, 2^-126, 3.1406250
  write_dataset(file, "opaque", opaque, {0x80, 0x3f, 0x20, 0xc0, 0x80, 0x00, 0x49, 0x40});
  write_dataset(file, "little", little, {0x80, 0x3f, 0x20, 0xc0, 0x80, 0x00, 0x49, 0x40});
  write_dataset(file, "big", big, {0x3f, 0x80, 0xc0, 0x20, 0x00, 0x80, 0x40, 0x49});
  for (const hid_t type : {opaque, little, big}) H5Tclose(type);
  H5Fclose(file);
  const Hdf5File read = Hdf5File::open(path);
  for (const char* name : {"opaque", "little", "big"}) {
    INFO(name);
    CHECK(read.read<float>(name).values == std::vector<float>{1, -2.5f, 0x1p-126f, 3.140625f});
  }
}
