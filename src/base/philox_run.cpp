#include <algorithm>

#include "base/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/philox_run.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void philox_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words) {
  for (std::size_t step = 0; step < kPhiloxRun; ++step, ++counter[2]) {
    const auto of_step = philox4x32(counter, key);
    std::copy(of_step.begin(), of_step.end(), words.begin() + 4 * step);
  }
}

void philox_columns(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, const std::uint32_t* first,
                    std::size_t count, const std::array<std::uint32_t*, 4>& words) {
  for (std::size_t i = 0; i < count; ++i) {
    counter[0] = first[i];
    const auto of_counter = philox4x32(counter, key);
    for (std::size_t word = 0; word < 4; ++word) {
      std::uint32_t* const row = words[word];
      row[i] = of_counter[word];
    }
  }
}

#else

/// One step in each lane of 64 bits. The upper halves of the lanes have no meaning.
using Steps = hn::CappedTag<std::uint64_t, 8>;
using StepVector = hn::Vec<Steps>;

HWY_INLINE StepVector product(StepVector a, std::uint32_t b) {
  const hn::Repartition<std::uint32_t, Steps> words;
  return hn::MulEven(hn::BitCast(words, a), hn::Set(words, b));
}

/// The ten rounds on kVectors vectors of counters, which fill each other's waits. The upper halves of the lanes must be
/// 0 or have no meaning.
template <std::size_t kVectors>
HWY_INLINE void ten_rounds(StepVector (&c)[kVectors][4], std::array<std::uint32_t, 2> key) {
  const Steps d;
  for (int round = 0; round < 10; ++round, key = {key[0] + 0x9E3779B9, key[1] + 0xBB67AE85}) {
    const auto k0 = hn::Set(d, key[0]), k1 = hn::Set(d, key[1]);
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto p0 = product(c[v][0], 0xD2511F53), p1 = product(c[v][2], 0xCD9E8D57);
      c[v][0] = hn::Xor(hn::ShiftRight<32>(p1), hn::Xor(c[v][1], k0));
      c[v][1] = p1;
      c[v][2] = hn::Xor(hn::ShiftRight<32>(p0), hn::Xor(c[v][3], k1));
      c[v][3] = p0;
    }
  }
}

/// words[w][i]: word w of the counter that begins with first[i].
void philox_columns(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, const std::uint32_t* first,
                    std::size_t count, const std::array<std::uint32_t*, 4>& words) {
  const Steps d;
  const hn::Rebind<std::uint32_t, Steps> halves;
  constexpr std::size_t kVectors = 2;
  const std::size_t lanes = hn::Lanes(d), together = kVectors * lanes;
  for (std::size_t i = 0; i < count; i += together) {
    // The last ones are made with others, and moved back.
    const std::size_t begin = count < together ? 0 : std::min(i, count - together);
    alignas(64) std::uint32_t few[2 * kVectors * 8] = {};
    const bool is_short = count < together;
    if (is_short) std::copy(first, first + count, few);
    const std::uint32_t* from = is_short ? few : first + begin;
    StepVector c[kVectors][4];
    for (std::size_t v = 0; v < kVectors; ++v) {
      c[v][0] = hn::PromoteTo(d, hn::LoadU(halves, from + v * lanes));
      for (std::size_t word = 1; word < 4; ++word) c[v][word] = hn::Set(d, counter[word]);
    }
    ten_rounds(c, key);
    for (std::size_t word = 0; word < 4; ++word)
      for (std::size_t v = 0; v < kVectors; ++v) {
        const auto made = hn::TruncateTo(halves, c[v][word]);
        if (is_short)
          hn::StoreU(made, halves, few + v * lanes);
        else
          hn::StoreU(made, halves, words[word] + begin + v * lanes);
        if (is_short && v + 1 == kVectors) std::copy(few, few + count, words[word]);
      }
  }
}

void philox_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words) {
  const Steps d;
  constexpr std::size_t kVectors = kPhiloxRun / hn::MaxLanes(Steps());  // they wait for each other's rounds
  const std::size_t lanes = hn::Lanes(d);
  StepVector c[kVectors][4];
  for (std::size_t v = 0; v < kVectors; ++v)
    for (std::size_t word = 0; word < 4; ++word)
      c[v][word] = word == 2 ? hn::Iota(d, counter[2] + v * lanes) : hn::Set(d, counter[word]);
  ten_rounds(c, key);
  std::uint64_t pairs[2 * kPhiloxRun];
  const auto low = hn::Set(d, 0xffffffff);
  for (std::size_t v = 0; v < kVectors; ++v)
    hn::StoreInterleaved2(hn::Or(hn::And(c[v][0], low), hn::ShiftLeft<32>(c[v][1])),
                          hn::Or(hn::And(c[v][2], low), hn::ShiftLeft<32>(c[v][3])), d, pairs + 2 * v * lanes);
  for (std::size_t i = 0; i < 2 * kPhiloxRun; ++i) {
    words[2 * i] = static_cast<std::uint32_t>(pairs[i]);
    words[2 * i + 1] = static_cast<std::uint32_t>(pairs[i] >> 32);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace svnet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet {

HWY_EXPORT(philox_run);
HWY_EXPORT(philox_columns);

void philox4x32_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words) {
  HWY_DYNAMIC_DISPATCH(philox_run)(counter, key, words);
}

void random_words_of_each(std::uint64_t seed, Stream stream, std::uint32_t high, const std::uint32_t* low,
                          std::size_t count, std::uint32_t step, std::array<std::uint32_t*, 4> words) {
  HWY_DYNAMIC_DISPATCH(philox_columns)
  ({0, high, step, static_cast<std::uint32_t>(stream)},
   {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, low, count, words);
}

}  // namespace svnet
#endif
