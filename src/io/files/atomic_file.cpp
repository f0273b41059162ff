#include "io/files/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "io/files/descriptor.h"
#include "io/files/temporary_name.h"

namespace svnet::io {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// The end of a chain of symbolic links.
fs::path followed(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as Linux allows
  fs::path target = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    check(links < kMostLinks, path.string(), ": cannot be written: too many symbolic links");
    const fs::path next = fs::read_symlink(target, error);
    if (error) fail_to_write(path, error.value());
    target = folder_of(target) / next;
  }
  return target;
}

/// The file that a write to `path` replaces. Throws Error for devices and folders, which a rename would replace or fail
/// to replace.
fs::path checked_target(const fs::path& path) {
  check(path.has_filename(), "'", path.string(), "': not the name of a file; give one that can be written");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  check(!fs::is_directory(status), path.string(), ": cannot be written: it is a folder; give the name of a file");
  check(!fs::exists(status) || fs::is_regular_file(status), path.string(),
        ": cannot be written: it exists and is not a regular file; give another name");
  fs::path target = followed(path);
  const fs::path folder = folder_of(target);
  const fs::file_status folder_status = fs::status(folder, error);
  check(folder_status.type() != fs::file_type::not_found, path.string(), ": cannot be written: the folder ",
        folder.string(), " does not exist; create it first");
  return target;
}

/// Whether `path` is a pipe or a character device.
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::is_fifo(status) || fs::is_character_file(status);
}

/// Whether both paths name one file, which need not exist.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const bool exists = fs::exists(a, error);
  if (exists != fs::exists(b, error)) return false;
  return exists ? fs::equivalent(a, b, error) : fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

/// The process that made a temporary file of the target, from the file's name; 0 for any other name.
pid_t maker_of(const std::string& name, const std::string& prefix) {
  unsigned pid = 0, counter = 0;
  int length = 0;
  if (!name.starts_with(prefix)) return 0;
  const char* rest = name.c_str() + prefix.size();
  if (std::sscanf(rest, "%9u-%9u.tmp%n", &pid, &counter, &length) != 2 || length == 0 || rest[length] != '\0') return 0;
  return static_cast<pid_t>(pid);
}

/// Removes the temporary files of processes that were killed while they wrote the target.
void remove_stale_temporaries(const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end; entry.increment(error)) {
    const pid_t maker = maker_of(entry->path().filename().string(), prefix);
    if (maker > 0 && ::kill(maker, 0) != 0 && errno == ESRCH) ::unlink(entry->path().c_str());
  }
}

/// A new file beside the target. It is removed unless it was renamed to the target.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    remove_stale_temporaries(target);
    for (;;) {
      path_ = folder_of(target) / joined(temporary_prefix(target), ::getpid(), "-", counter++, ".tmp");
      const Descriptor file(::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
      if (file.number() >= 0) return;
      if (errno != EEXIST) fail_to_write(target, errno);
    }
  }
  ~Temporary() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path& path() const { return path_; }

  void sync_and_rename(const fs::path& target) {
    {
      struct stat replaced {};
      constexpr mode_t kModeBits = 07777;
      if (::stat(target.c_str(), &replaced) == 0 && ::chmod(path_.c_str(), replaced.st_mode & kModeBits) != 0)
        fail_to_write(target, errno);
      const Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
      if (file.number() < 0 || synced(file.number()) != 0) fail_to_write(target, errno);
    }
    if (::rename(path_.c_str(), target.c_str()) != 0) fail_to_write(target, errno);
    path_.clear();
  }

 private:
  fs::path path_;
};

}  // namespace

void make_rename_last(const fs::path& target) {
  const Descriptor folder(::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.number() < 0) return;
  if (synced(folder.number()) != 0 && errno == EIO) fail_to_write(target, errno);
}

void write_atomically(const fs::path& path, const std::function<void(const fs::path& temporary)>& write) {
  const fs::path target = checked_target(path);
  Temporary temporary(target);
  write(temporary.path());
  temporary.sync_and_rename(target);
  make_rename_last(target);
}

void write_atomically(const fs::path& path, std::string_view contents) {
  if (is_standard_output(path)) return write_all(path, Descriptor(::dup(STDOUT_FILENO)), contents);
  if (is_stream(path)) return write_all(path, Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC)), contents);
  write_atomically(path, [&](const fs::path& temporary) {
    write_all(path, Descriptor(::open(temporary.c_str(), O_WRONLY | O_CLOEXEC)), contents);
  });
}

bool is_standard_output(const fs::path& path) {
  struct stat file {
  }, output{};
  return !path.empty() && ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &output) == 0 &&
         file.st_dev == output.st_dev && file.st_ino == output.st_ino;
}

void check_can_be_written(const fs::path& path, const std::vector<fs::path>& others, Streams streams) {
  if (streams == Streams::allowed && (is_standard_output(path) || is_stream(path))) return;
  const Temporary temporary(checked_target(path));
  for (const fs::path& other : others)
    check(other.empty() || !same_file(path, other), path.string(),
          ": cannot be written: the command needs this file for something else; give another name");
}

}  // namespace svnet::io
