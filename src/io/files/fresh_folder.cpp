#include "io/files/fresh_folder.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "io/files/atomic_file.h"
#include "io/files/descriptor.h"
#include "io/files/make_folder.h"
#include "io/files/temporary_name.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;

/// The folder that `name` stands for, links followed. Throws Error unless it does not exist or is empty.
fs::path target_of(const fs::path& name) {
  check(!name.empty(), "'': not the name of a folder; give one that can be made");
  std::error_code error;
  fs::path target = fs::weakly_canonical(fs::absolute(name), error);
  check(!error, name.string(), ": cannot be made: ", error.message());
  if (!target.has_filename()) target = target.parent_path();  // after a '/'
  const fs::file_status status = fs::symlink_status(target);
  check(!fs::is_symlink(status), name.string(), ": is a link to nothing; remove it or choose another folder");
  check(!fs::equivalent(target, ".", error), name.string(), ": is the folder that this runs in; choose another one");
  check(!fs::exists(status) || (fs::is_directory(status) && fs::is_empty(target, error)), name.string(),
        ": exists already, remove it or choose another folder");
  return target;
}

/// A new, empty folder beside `target`.
fs::path folder_beside(const fs::path& target, const fs::path& name) {
  const std::string prefix = temporary_prefix(target);
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  for (unsigned counter = 0; !error; ++counter) {
    fs::path folder = target.parent_path() / joined(prefix, ::getpid(), "-", counter, ".tmp");
    if (::mkdir(folder.c_str(), 0777) == 0) return folder;
    if (errno != EEXIST) error.assign(errno, std::generic_category());
  }
  fail(name.string(), ": cannot be made: ", error.message());
}

/// Renames `folder` to `target`, which must not exist or be an empty folder. Errors call it `name`.
void give_name(const fs::path& folder, const fs::path& target, const fs::path& name) {
  std::error_code error;
  fs::rename(folder, target, error);
  check(error != std::errc::device_or_resource_busy, name.string(), ": is a mount point; choose a folder in it");
  check(
      error != std::errc::directory_not_empty && error != std::errc::file_exists && error != std::errc::not_a_directory,
      name.string(), ": has come to exist meanwhile; remove it or choose another folder");
  check(!error, name.string(), ": cannot be made: ", error.message());
}

/// A new folder that give_name can rename to `target`. If the target exists, a first folder is renamed to it right
/// away, so that a target that the system refuses to replace is found before the work.
fs::path partial_of(const fs::path& target, const fs::path& name) {
  fs::path folder = folder_beside(target, name);
  if (!fs::exists(target)) return folder;
  try {
    give_name(folder, target, name);
  } catch (const Error&) {
    fs::remove(folder);
    throw;
  }
  return folder_beside(target, name);
}

/// Brings a file or folder to the disk. Throws Error, which calls it `name`, if that fails.
void sync_one(const fs::path& path, const fs::path& name) {
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.number() < 0 || synced(descriptor.number()) != 0) fail_to_write(name, errno);
}

/// Brings all that `folder` holds to the disk, together with what else was written to its file system. If that fails,
/// perhaps for a file of another program, each file alone. Throws Error, which calls the folder `name`, if that fails.
void sync_folder(const fs::path& folder, const fs::path& name) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.number() >= 0 && ::syncfs(descriptor.number()) == 0) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) sync_one(entry.path(), name);
  sync_one(folder, name);
}

}  // namespace

FreshFolder::FreshFolder(const fs::path& path)
    : name_(path), target_(target_of(path)), partial_(partial_of(target_, path)) {}

FreshFolder::~FreshFolder() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void FreshFolder::add(const fs::path& relative, std::string_view contents) {
  const fs::path path = partial_ / relative;
  make_folder(path.parent_path());
  has_added_ = true;
  const Descriptor file(::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
  write_all(path, file, contents);
}

void FreshFolder::keep() {
  if (has_added_) sync_folder(partial_, name_);
  give_name(partial_, target_, name_);
  make_rename_last(target_);
}

}  // namespace svnet::io
