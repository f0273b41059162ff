#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/communicator.h"
#include "base/error.h"
#include "base/progress.h"

namespace svnet {

/// What `read` returns for a file whose input_fingerprint is `wanted`; nothing where it is to be made again, because it
/// does not exist, is of something else or cannot be read. All processes of a communicator do as the first one finds.
template <class Read>
auto reused_file(const std::filesystem::path& path, const std::string& wanted, const Read& read,
                 Communicator& communicator, const Messages& messages) -> std::optional<decltype(read(path))> {
  std::optional<decltype(read(path))> found;
  if (communicator.is_root() && std::filesystem::exists(path)) try {
      found = read(path);
      if (found->input_fingerprint != wanted) found.reset();
    } catch (const Error& error) {
      if (messages.line) messages.line(joined("made again: ", error.what()));
    }
  const bool use = communicator.broadcast(found.has_value()) != 0;
  if (!use || found) return found;
  found = read(path);
  check(found->input_fingerprint == wanted, path.string(), ": process ", communicator.rank(),
        " sees another file than process 0; the folder must be one that all processes share");
  return found;
}

}  // namespace svnet
