#include "io/hdf5/library.h"

#include <cstring>
#include <mutex>

#include "base/error.h"
#include "io/hdf5/error_stack.h"

namespace svnet::io::hdf5 {
namespace {

// How the library keeps the bytes of a file in memory. It would copy them: here all copies are the same memory.

void* same_memory(std::size_t, H5FD_file_image_op_t, void* bytes) { return bytes; }
void* copy_unless_same(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return to == from ? to : std::memcpy(to, from, size);
}
void* never_larger(void*, std::size_t, H5FD_file_image_op_t, void*) { return nullptr; }
herr_t keep(void*, H5FD_file_image_op_t, void*) { return 0; }
void* same_data(void* bytes) { return bytes; }
herr_t keep_data(void*) { return 0; }

Handle opened(const std::string& name, const char* path, const Handle& access) {
  Handle file(H5Fopen(path, H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (file.id() < 0) {
    const std::string why = reason();
    fail(name, why.starts_with("out of memory") ? ": cannot be read: " : ": damaged or incomplete HDF5 file: ", why);
  }
  return file;
}

}  // namespace

// Filters in shared libraries named by a file or by HDF5_PLUGIN_PATH would be code from outside. The library's own
// cleaning up at exit prints when a damaged file left something behind in it; there is nothing to clean up, because
// every file is closed by its owner.
void prepare_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    H5dont_atexit();
    H5open();
    H5PLset_loading_state(0);
  });
}

Handle access_properties() {
  Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(properties.id(), false, true);
#endif
  return properties;
}

Handle open_for_reading(const std::filesystem::path& path) {
  const Handle access = access_properties();
  return opened(path.string(), path.c_str(), access);
}

Handle open_image(const std::string& name, void* bytes, std::uint64_t size) {
  const Handle access = access_properties();
  H5FD_file_image_callbacks_t callbacks{same_memory, copy_unless_same, never_larger, keep, same_data, keep_data, bytes};
  constexpr std::size_t kIncrement = std::size_t{1} << 16;
  const bool set = H5Pset_fapl_core(access.id(), kIncrement, false) >= 0 &&
                   H5Pset_file_image_callbacks(access.id(), &callbacks) >= 0 &&
                   H5Pset_file_image(access.id(), bytes, size) >= 0;
  check(set, name, ": cannot be read: ", reason());
  return opened(name, "the file's bytes", access);
}

}  // namespace svnet::io::hdf5
