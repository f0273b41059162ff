#pragma once

namespace svnet::train {

/// What a stage does with a file that an earlier run left: with the result, a snapshot of the scores or a checkpoint.
enum class Resume {
  never,  ///< ignore it
  same,   ///< resume from it if its fingerprint matches; otherwise, or if it cannot be read, start again
  any     ///< resume from it; throw Error if its fingerprint differs or it cannot be read
};

}  // namespace svnet::train
