#include "io/hdf5/hdf5_file.h"

#include <algorithm>
#include <mutex>
#include <system_error>

#include "base/text.h"
#include "io/files/file_format.h"
#include "io/hdf5/file_state.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;
using hdf5::object_place;
using hdf5::Quiet;

/// To be called before anything else of the library. Filters in shared libraries named by a file or by HDF5_PLUGIN_PATH
/// would be code from outside. The library's own cleaning up at exit prints when a damaged file left something behind
/// in it; there is nothing to clean up, because every file is closed by its owner.
void prepare_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    H5dont_atexit();
    H5PLset_loading_state(0);
  });
}

/// No locks: files are replaced as a whole, and network file systems often have none.
Handle access_properties() {
  Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(properties.id(), false, true);
#endif
  return properties;
}

std::uint64_t size_of_regular_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  check(status.type() != fs::file_type::not_found, path.string(), ": no such file");
  check(!error, path.string(), ": cannot be read: ", error.message());
  check(!fs::is_directory(status), path.string(),
        ": is a folder, such as TensorFlow's SavedModel; expected an HDF5 file");
  check(fs::is_regular_file(status), path.string(), ": is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  check(!error, path.string(), ": cannot be read: ", error.message());
  return size;
}

herr_t append_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (...) {
    return -1;
  }
}

}  // namespace

Hdf5File::Hdf5File(std::unique_ptr<hdf5::File> state) : state_(std::move(state)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() {
  const Quiet quiet;
  state_.reset();
}

Hdf5File Hdf5File::open(const fs::path& path) {
  prepare_library();
  const Quiet quiet;
  auto state = std::make_unique<hdf5::File>();
  state->name = path.string();
  state->size = size_of_regular_file(path);
  const htri_t recognised = H5Fis_hdf5(path.c_str());
  check(recognised >= 0, path.string(), ": cannot be read: ", hdf5::reason());
  if (recognised == 0) fail(path.string(), ": is not an HDF5 file", recognised_instead(path));
  const Handle access = access_properties();
  state->file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (state->file.id() < 0) fail(path.string(), ": damaged or incomplete HDF5 file: ", hdf5::reason());
  state->look_up_layout();
  return Hdf5File(std::move(state));
}

Hdf5File Hdf5File::create(const fs::path& path, const std::string& name_in_messages) {
  prepare_library();
  const Quiet quiet;
  auto state = std::make_unique<hdf5::File>();
  state->name = name_in_messages.empty() ? path.string() : name_in_messages;
  const Handle access = access_properties();
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  state->file = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (state->file.id() < 0) fail(state->name, ": cannot be written: ", hdf5::reason());
  return Hdf5File(std::move(state));
}

void Hdf5File::close() {
  const Quiet quiet;
  const bool flushed = H5Fflush(state_->file.id(), H5F_SCOPE_GLOBAL) >= 0;
  if (!flushed) fail(state_->name, ": cannot be written: ", hdf5::reason());
  if (!state_->file.reset()) fail(state_->name, ": cannot be written: ", hdf5::reason());
}

const std::string& Hdf5File::name() const { return state_->name; }

bool Hdf5File::has(const std::string& object) const {
  const Quiet quiet;
  const std::string where = object_place(object);
  std::string so_far;
  for (const std::string& part : hdf5::path_parts(object)) {
    const Handle parent = state_->object(so_far);
    if (H5Iget_type(parent.id()) != H5I_GROUP) return false;
    if (state_->done(H5Lexists(parent.id(), part.c_str(), H5P_DEFAULT), where, "cannot be looked up") == 0)
      return false;
    so_far += "/" + part;
  }
  return true;
}

bool Hdf5File::is_group(const std::string& object) const {
  if (!has(object)) return false;
  const Quiet quiet;
  return H5Iget_type(state_->object(object).id()) == H5I_GROUP;
}

std::vector<std::string> Hdf5File::members(const std::string& group) const {
  const Quiet quiet;
  const Handle handle = state_->group(group);
  std::vector<std::string> names;
  state_->done(H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, append_name, &names),
               object_place(group), "its members cannot be listed");
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

}  // namespace svnet::io
