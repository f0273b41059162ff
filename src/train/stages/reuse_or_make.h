#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "train/run.h"
#include "train/stage_times.h"
#include "train/stages/resume.h"

namespace svnet::train {

/// The file that a stage writes.
struct StageFile {
  std::filesystem::path path;
  std::string fingerprint;  ///< of everything that the file should depend on
  std::string content;      ///< "scores": what messages call it
  Resume resume = Resume::same;
};

/// What `read` returns for the file, or nothing if it must be made: if there is none, or if `file.resume` says so.
/// All processes do what the root process finds.
template <class Read>
auto reused(const Run& run, const StageFile& file, const Read& read) -> std::optional<decltype(read(file.path))> {
  std::optional<decltype(read(file.path))> found;
  if (file.resume != Resume::never && run.communicator.is_root() && std::filesystem::exists(file.path)) try {
      found = read(file.path);
      const bool same = found->input_fingerprint == file.fingerprint;
      check(same || file.resume != Resume::any, file.path.string(), ": was made with other inputs or options");
      if (!same) found.reset();
    } catch (const Error& error) {
      if (file.resume == Resume::any) throw;
      run.say(joined("made again: ", error.what()));
    }
  const bool use = run.communicator.broadcast(found.has_value()) != 0;
  if (!use || found) return found;
  found = read(file.path);
  check(found->input_fingerprint == file.fingerprint, file.path.string(), ": process ", run.communicator.rank(),
        " sees another file than process 0; the folder must be one that all processes share");
  return found;
}

/// The result of a stage. It is read from its file if it can be reused; otherwise it is made, and the root process
/// writes it while the others wait. `read(path)` and `make()` return the same type, which has an input_fingerprint;
/// `write(path, result)` writes it.
template <class Read, class Make, class Write>
auto reuse_or_make(const Run& run, const StageFile& file, const Read& read, const Make& make, const Write& write)
    -> decltype(make()) {
  StageTimer timer(run, file.content);
  if (auto found = reused(run, file, read)) {
    run.say(joined(file.content, ": reused ", file.path.filename().string()));
    timer.reused();
    return std::move(*found);
  }
  auto made = make();
  if (run.communicator.is_root()) write(file.path, made);
  run.communicator.barrier();
  timer.made();
  return made;
}

}  // namespace svnet::train
