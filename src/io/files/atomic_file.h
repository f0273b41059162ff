#pragma once
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace svnet {

/// Replaces the file `path` as a whole: readers, and a machine that loses power, see the old file or the new one, never
/// a part. A new, empty temporary file in the same folder (its name begins with a dot) is handed to `write`, which
/// fills it and closes it; it is then synced to disk and renamed to `path`, and the folder is synced. If anything
/// throws, the temporary is removed and `path` is left as it was. What a process that was killed while it wrote `path`
/// has left behind is removed by the next one that writes it.
///
/// `path` must not exist or be a regular file; of a symbolic link it is what the link points to, and the link stays.
/// Throws Error that names `path` and says what the system said; exceptions of `write` pass through.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for contents that are in memory.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// Throws the Error that write_atomically would throw for this path, as far as it can be known beforehand: to be called
/// before the work whose result is to be written. Throws as well where it is one of `others`, which the command reads
/// or writes besides and which would be lost; empty ones are none.
void check_can_be_written(const std::filesystem::path& path, const std::vector<std::filesystem::path>& others = {});

/// After something was renamed to `target`: so that it stays so when power fails. A folder that may be written but not
/// read, or whose file system syncs no folders, is left to the system. Throws Error for a failing disk.
void make_rename_last(const std::filesystem::path& target);

}  // namespace svnet
