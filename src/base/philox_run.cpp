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

#else

/// One step in each lane of 64 bits. The upper halves of the lanes have no meaning.
using Steps = hn::CappedTag<std::uint64_t, 8>;
using StepVector = hn::Vec<Steps>;

HWY_INLINE StepVector product(StepVector a, std::uint32_t b) {
  const hn::Repartition<std::uint32_t, Steps> words;
  return hn::MulEven(hn::BitCast(words, a), hn::Set(words, b));
}

void philox_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words) {
  const Steps d;
  constexpr std::size_t kVectors = kPhiloxRun / hn::MaxLanes(Steps());  // they wait for each other's rounds
  const std::size_t lanes = hn::Lanes(d);
  StepVector c[kVectors][4];
  for (std::size_t v = 0; v < kVectors; ++v)
    for (std::size_t word = 0; word < 4; ++word)
      c[v][word] = word == 2 ? hn::Iota(d, counter[2] + v * lanes) : hn::Set(d, counter[word]);
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

void philox4x32_run(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key, PhiloxRun& words) {
  HWY_DYNAMIC_DISPATCH(philox_run)(counter, key, words);
}

}  // namespace svnet
#endif
