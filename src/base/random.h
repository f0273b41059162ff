#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/index.h"

namespace svnet {

/// The purpose of a random stream. Each purpose has its own stream, so that a change in one use of randomness does not
/// change the others. Every result depends on these values: never change one.
enum class Stream : std::uint32_t {
  weights = 1,
  dropout = 2,
  shuffle = 3,
  problem = 4,
  kmeans = 5,
  selector = 6,
  evaluation = 7,
  cross_validation = 8,
  collection = 9,
  augmentation = 10,
  bootstrap = 11,
  components = 12,
  table = 13,
  pairs = 14,
};

/// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011): ten rounds on `counter`
/// under `key`, with the order of words of Random123.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// The words of sixteen consecutive steps, in order. With wide vectors, sixteen steps take little more time than
/// one.
inline constexpr std::size_t kPhiloxRun = 16;
using PhiloxRun = std::array<std::uint32_t, 4 * kPhiloxRun>;
void philox4x32_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words);

/// The four words of step `step` of the stream with this index: counter = (index low, index high, step, stream),
/// key = (seed low, seed high).
inline std::array<std::uint32_t, 4> random_words(std::uint64_t seed, Stream stream, std::uint64_t index,
                                                 std::uint32_t step) {
  return philox4x32({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), step,
                     static_cast<std::uint32_t>(stream)},
                    {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
}

/// The words of step `step` of `count` indices high << 32 | low[i], as random_words: word w of index i in words[w][i].
void random_words_of_each(std::uint64_t seed, Stream stream, std::uint32_t high, const std::uint32_t* low,
                          std::size_t count, std::uint32_t step, std::array<std::uint32_t*, 4> words);

/// The random numbers of one index of a stream: key = seed (low word first), counter = index (low, high), step,
/// stream. They do not depend on threads, ranks or interruptions. A stream gives 2^34 words, then repeats.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, Stream stream, std::uint64_t index = 0)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        counter_{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), 0,
                 static_cast<std::uint32_t>(stream)} {}

  /// The words of step 0, then of step 1, …, in order.
  std::uint32_t bits32() {
    if (used_ == words_.size()) {
      philox4x32_run(counter_, key_, words_);
      counter_[2] += kPhiloxRun;
      used_ = 0;
    }
    return words_[used_++];
  }

  /// Low word first.
  std::uint64_t bits64() {
    const std::uint64_t low = bits32();
    return low | (static_cast<std::uint64_t>(bits32()) << 32);
  }

  /// Uniform in [0, n), n > 0: the high word of bits32() · n. A draw whose low word is below 2^32 mod n is rejected, so
  /// every value is equally likely (Lemire, "Fast random integer generation in an interval", 2019).
  std::uint32_t below(std::uint32_t n) {
    for (;;) {
      const std::uint64_t product = static_cast<std::uint64_t>(bits32()) * n;
      const auto low = static_cast<std::uint32_t>(product);
      if (low >= n || low >= (0u - n) % n) return static_cast<std::uint32_t>(product >> 32);
    }
  }

  /// Uniform in [0, 1): the upper 53 bits of bits64() · 2^-53.
  double uniform() { return static_cast<double>(bits64() >> 11) * 0x1p-53; }

  /// Standard normal: √(-2 ln(1 - u)) cos(2π v) of two uniforms u, v in that order. This is the first number of the
  /// pair of Box and Muller (1958).
  double normal();

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  PhiloxRun words_{};
  std::size_t used_ = words_.size();
};

/// Moves `count` of the n items to the front: a uniform draw without replacement, in draw order (Fisher–Yates).
template <class Item>
void draw_without_replacement(RandomStream& random, Item* items, Index n, Index count) {
  for (Index i = 0; i < count; ++i) {
    const Index j = i + random.below(static_cast<std::uint32_t>(n - i));
    const Item swapped = items[i];
    items[i] = items[j];
    items[j] = swapped;
  }
}

}  // namespace svnet
