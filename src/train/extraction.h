#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "nn/tensor.h"

namespace svnet::train {

/// How numbered inputs become rows of values.
struct Extraction {
  std::string network;  ///< its name, for messages
  Index count = 0;      ///< of the inputs
  Index dimension = 0;  ///< of a row
  Index batch = 16;     ///< the most inputs that share a run; a multiple of `unit`
  Index unit = 1;       ///< inputs [k unit, (k + 1) unit) are always in the same batch
  /// How many floats a run of so many inputs needs besides its inputs and rows. None: as good as nothing.
  std::function<Index(Index inputs)> memory{};
  /// The inputs [begin, end) as a batch. Is called in several threads at the same time.
  std::function<Tensor(Index begin, Index end, Parallel& parallel)> prepared;
  /// The rows of a batch, (inputs, dimension) in order. Is called in several threads at the same time.
  std::function<Tensor(const Tensor& batch)> run;
  /// What an input is called in the message that a value is not finite.
  std::function<std::string(Index input)> name;
  /// The rows of the first inputs, made before. Of a single process only.
  std::vector<float> made{};
  /// Is given the rows of the first inputs about once a minute, and if messages.progress throws. Of a single process
  /// only.
  std::function<void(std::span<const float> rows)> keep{};
};

/// The rows of all inputs, (count, dimension). Requires that the bits of a row do not depend on its batch.
///
/// Each thread of the shared pool takes a batch from its inputs to its rows and then the next batch, so that no thread
/// waits for another; batches get smaller towards the end. But if the inputs are too few for that, or every thread's
/// own memory would be too much, all threads work on one batch, and others prepare the next one meanwhile. The
/// processes of the communicator share the inputs, and each gets all rows.
///
/// Throws what `prepared` and `run` throw, and Error if a value is not finite: what happened in the first batch in
/// which something did.
std::vector<float> extracted(const Extraction& extraction, const Messages& messages, Communicator& communicator);

}  // namespace svnet::train
