#include "io/hdf5/hdf5_file.h"

#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/files/file_format.h"
#include "io/hdf5/answer.h"
#include "io/hdf5/library.h"
#include "io/hdf5/open_file.h"
#include "sandbox/mode.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;
using hdf5::Quiet;

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

/// Whether an HDF5 file begins at one of the places where one may (after a user block of 512, 1024, … bytes).
bool has_signature(const fs::path& path, std::uint64_t size) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  check(file.is_open(), path.string(), ": cannot be read: ", std::generic_category().message(errno));
  for (std::uint64_t start = 0; start + kSignature.size() <= size; start = start == 0 ? 512 : 2 * start) {
    char found[kSignature.size()]{};
    file.seekg(static_cast<std::streamoff>(start));
    if (file.read(found, sizeof found) && std::string_view(found, sizeof found) == kSignature) return true;
    file.clear();
  }
  return false;
}

}  // namespace

void hdf5::OpenFile::answer(const Request& request, Sink& sink) const {
  if (elsewhere != nullptr) return elsewhere->answer(request, sink);
  const Quiet quiet;
  hdf5::answer(here, request, sink);
}

Hdf5File::Hdf5File(std::unique_ptr<hdf5::OpenFile> state) : state_(std::move(state)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() {
  const Quiet quiet;
  state_.reset();
}

Hdf5File Hdf5File::open(const fs::path& path) {
  hdf5::prepare_library();
  auto state = std::make_unique<hdf5::OpenFile>();
  state->here.name = path.string();
  state->here.size = size_of_regular_file(path);
  if (!has_signature(path, state->here.size)) fail(path.string(), ": is not an HDF5 file", recognised_instead(path));
  if (sandbox::mode() == sandbox::Mode::on) {
    state->elsewhere = std::make_unique<hdf5::RemoteFile>(path, state->here.size);
  } else {
    const Quiet quiet;
    state->here.file = hdf5::open_for_reading(path);
  }
  return Hdf5File(std::move(state));
}

Hdf5File Hdf5File::create(const fs::path& path, const std::string& name_in_messages) {
  hdf5::prepare_library();
  const Quiet quiet;
  auto state = std::make_unique<hdf5::OpenFile>();
  hdf5::File& file = state->here;
  file.name = name_in_messages.empty() ? path.string() : name_in_messages;
  const Handle access = hdf5::access_properties();
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  file.file = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (file.file.id() < 0) fail(file.name, ": cannot be written: ", hdf5::reason());
  return Hdf5File(std::move(state));
}

void Hdf5File::close() {
  const Quiet quiet;
  hdf5::File& file = state_->here;
  const bool flushed = H5Fflush(file.file.id(), H5F_SCOPE_GLOBAL) >= 0;
  if (!flushed) fail(file.name, ": cannot be written: ", hdf5::reason());
  if (!file.file.reset()) fail(file.name, ": cannot be written: ", hdf5::reason());
}

const std::string& Hdf5File::name() const { return state_->here.name; }

}  // namespace svnet::io
