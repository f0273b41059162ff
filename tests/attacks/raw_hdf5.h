#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <hdf5.h>

namespace svnet::attacks {

/// An HDF5 file that is written through the C interface, in the layout of Keras' legacy weights: a layer "dense" with
/// the array "dense/dense/kernel:0". Identifiers are closed with the file.
class RawHdf5 {
 public:
  static constexpr const char* kKernel = "dense/dense/kernel:0";

  explicit RawHdf5(const std::filesystem::path& file, hid_t creation = H5P_DEFAULT) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    id_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access);
    H5Pclose(access);
  }
  ~RawHdf5() { H5Fclose(id_); }
  RawHdf5(const RawHdf5&) = delete;
  RawHdf5& operator=(const RawHdf5&) = delete;

  hid_t id() const { return id_; }
  hid_t group(const char* name) const { return H5Gcreate2(id_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT); }

  /// The groups and lists of names of the layer, without its array.
  void layer() const {
    group("dense");
    group("dense/dense");
    texts("/", "layer_names", {"dense"});
    texts("dense", "weight_names", {"dense/kernel:0"});
  }

  static hid_t variable_text() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
  }
  void texts(const char* object, const char* name, std::vector<const char*> values) const {
    const hsize_t count = values.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr), type = variable_text();
    const hid_t attribute = H5Acreate_by_name(id_, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, values.data());
  }

  hid_t dataset(const char* name, std::vector<hsize_t> dims, hid_t type, hid_t creation = H5P_DEFAULT) const {
    const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
    return H5Dcreate2(id_, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  }
  hid_t kernel(std::vector<hsize_t> dims, hid_t type = H5T_IEEE_F32LE, hid_t creation = H5P_DEFAULT) const {
    return dataset(kKernel, std::move(dims), type, creation);
  }
  /// 64 floats.
  void small_kernel(hid_t creation = H5P_DEFAULT) const {
    const std::array<float, 64> values{};
    H5Dwrite(kernel({64}, H5T_IEEE_F32LE, creation), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  static hid_t chunked(hsize_t chunk) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &chunk);
    return creation;
  }

 private:
  hid_t id_;
};

}  // namespace svnet::attacks
