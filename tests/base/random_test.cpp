#include "base/random.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/instruction_sets.h"

using namespace svnet;
using namespace svnet::test;

TEST_CASE("Philox4x32-10 gives Random123's known answers") {
  using Words = std::array<std::uint32_t, 4>;
  CHECK(philox4x32({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}) == Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a random stream has the documented layout") {
  const std::uint64_t seed = 0x0123456789abcdef, index = 0xfedcba9876543210;
  for_instruction_sets([&](const std::string& isa) {
    INFO(isa);
    RandomStream random(seed, Stream::shuffle, index);
    for (std::uint32_t step = 0; step < 40; ++step)
      for (std::uint32_t word : philox4x32({0x76543210, 0xfedcba98, step, 3}, {0x89abcdef, 0x01234567}))
        CHECK(random.bits32() == word);
    PhiloxRun words{};
    philox4x32_run({1, 2, ~0u, 3}, {4, 5}, words);  // the step is 0 again
    CHECK(words[4] == philox4x32({1, 2, 0, 3}, {4, 5})[0]);
  });
}

TEST_CASE("the words of many indices are those of each index") {
  const std::uint64_t seed = 0x0123456789abcdef;
  for_instruction_sets([&](const std::string& isa) {
    INFO(isa);
    for (const std::size_t count : {0, 1, 2, 3, 5, 7, 8, 15, 16, 17, 31, 33, 100, 256}) {
      CAPTURE(count);
      std::vector<std::uint32_t> low(count), words[4];
      for (std::size_t i = 0; i < count; ++i) low[i] = static_cast<std::uint32_t>(~7u + 3 * i * i);
      for (auto& word : words) word.assign(count + 1, 77);
      random_words_of_each(seed, Stream::collection, 5, low.data(), count, 9,
                           {words[0].data(), words[1].data(), words[2].data(), words[3].data()});
      for (std::size_t w = 0; w < 4; ++w) {
        CHECK(words[w][count] == 77);  // nothing behind the last one
        for (std::size_t i = 0; i < count; ++i)
          CHECK(words[w][i] == random_words(seed, Stream::collection, std::uint64_t{5} << 32 | low[i], 9)[w]);
      }
    }
  });
}

TEST_CASE("below() is uniform and stays below") {
  RandomStream random(1, Stream::problem);
  std::vector<int> counts(7);
  constexpr int kDraws = 70000;
  for (int i = 0; i < kDraws; ++i) ++counts.at(random.below(7));
  double chi2 = 0;
  for (int count : counts) chi2 += (count - kDraws / 7.0) * (count - kDraws / 7.0) / (kDraws / 7.0);
  CHECK(chi2 < 22.5);  // 6 degrees of freedom, p = 0.001
  CHECK(RandomStream(1, Stream::problem).below(1) == 0);
}

TEST_CASE("normal() has mean 0 and variance 1") {
  RandomStream random(2, Stream::weights);
  constexpr int kDraws = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    REQUIRE(std::isfinite(x));
    sum += x, squares += x * x;
  }
  CHECK(std::abs(sum / kDraws) < 4 / std::sqrt(kDraws));
  CHECK(std::abs(squares / kDraws - 1) < 4 * std::sqrt(2.0 / kDraws));
}

TEST_CASE("draw_without_replacement gives every subset with equal chance") {
  std::vector<int> counts(1 << 5);
  constexpr int kDraws = 50000;
  for (int i = 0; i < kDraws; ++i) {
    RandomStream random(3, Stream::problem, i);
    std::vector<int> items{0, 1, 2, 3, 4};
    draw_without_replacement(random, items.data(), 5, 2);
    ++counts.at((1 << items[0]) | (1 << items[1]));
  }
  int subsets = 0;
  for (int count : counts) {
    if (count == 0) continue;
    ++subsets;
    CHECK(std::abs(count - kDraws / 10) < 4.5 * std::sqrt(kDraws * 0.09));
  }
  CHECK(subsets == 10);
}
