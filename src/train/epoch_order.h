#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/random.h"

namespace svnet::train {

/// The indices of all examples, in the random order of an epoch.
inline std::vector<std::int32_t> epoch_order(Index count, std::uint64_t seed, Index epoch) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  RandomStream random(seed, Stream::shuffle, static_cast<std::uint64_t>(epoch));
  draw_without_replacement(random, order.data(), count, count);
  return order;
}

/// The end of the batch that starts at `begin`. If a single example would be left, it joins the batch.
inline Index batch_end(Index begin, Index batch_size, Index count) {
  const Index end = std::min(begin + batch_size, count);
  return count - end == 1 ? count : end;
}

/// The number of batches in an epoch.
inline Index batch_count(Index batch_size, Index count) {
  Index batches = 0;
  for (Index begin = 0; begin < count; begin = batch_end(begin, batch_size, count)) ++batches;
  return batches;
}

}  // namespace svnet::train
