#pragma once
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace svnet::io {

/// Replaces the file `path` as a whole: a reader sees the old file or the new one, never a part, even after a power
/// failure. `write` receives the name of a new, empty file in the same folder, and fills and closes it. The file is
/// then synced to disk, gets the mode of the file that it replaces, and is renamed to `path`, and the folder is synced.
/// If anything throws, the temporary file is removed and `path` stays as it was. A process that is killed leaves its
/// temporary file; the next write of `path` removes it.
///
/// Requires that `path` does not exist or is a regular file; a symbolic link is followed and stays. Throws Error that
/// names `path` and gives the system's reason. Exceptions of `write` pass through.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for contents in memory, which may also go to a pipe, a character device or standard output: these receive
/// the bytes as they are written.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// Whether outputs may go to a pipe or a device, such as /dev/stdout, which cannot be replaced as a whole.
enum class Streams { refused, allowed };

/// Whether `path` is this process's standard output, by any name.
bool is_standard_output(const std::filesystem::path& path);

/// Throws Error if write_atomically would fail for this path, as far as that is known before the work. Also throws
/// Error if `path` is the same file as one of `others`, which the command reads or writes too. Empty paths in `others`
/// are ignored.
void check_can_be_written(const std::filesystem::path& path, const std::vector<std::filesystem::path>& others = {},
                          Streams streams = Streams::refused);

/// Syncs the folder of `target`, so that a rename to `target` survives a power failure. Does nothing if the folder
/// cannot be read or its file system cannot sync folders. Throws Error for a failing disk.
void make_rename_last(const std::filesystem::path& target);

}  // namespace svnet::io
