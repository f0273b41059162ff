#pragma once
#include <string>

#include <hdf5.h>

namespace svnet::hdf5 {

/// While one lives, the HDF5 library prints no errors from this thread.
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

/// The innermost message of the call that failed last, where the system refused something what the system said. Ask at
/// once: the next call of the library, even one that closes something, forgets it.
std::string reason();

}  // namespace svnet::hdf5
