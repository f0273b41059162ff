#pragma once
#include <string>

#include <hdf5.h>

namespace svnet::io::hdf5 {

/// Keeps the HDF5 library from printing errors of this thread, for the lifetime of the object.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Why the last call of the HDF5 library failed: its innermost message, or that of the operating system. To be called
/// at once, because the next call of the library clears the message.
std::string reason();

}  // namespace svnet::io::hdf5
