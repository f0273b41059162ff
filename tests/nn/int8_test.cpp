#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "base/instruction_sets.h"
#include "nn/kernels/int8/int8_gemm.h"
#include "nn/kernels/int8/int8_weights.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::kernels;

namespace {

std::vector<float> random_numbers(Index count, std::uint64_t seed) {
  const Tensor tensor = test::random_tensor({count}, seed, DType::f32);
  return {tensor.data<float>(), tensor.data<float>() + count};
}

}  // namespace

TEST_CASE("int8 weights are at most half a step away, and keep what is on their grid") {
  const ChannelShape shape{.outer = 3, .channels = 4, .inner = 5};
  std::vector<float> w = random_numbers(shape.size(), 3);
  for (Index o = 0; o < 3; ++o) std::fill_n(w.begin() + (o * 4 + 2) * 5, 5, 0.0f);  // a channel of zeros
  const Int8Weights first = int8_weights(shape, w.data());
  std::vector<float> rounded(w.size()), again(w.size());
  from_int8(shape, first.values, first.scales, rounded.data());
  for (std::size_t i = 0; i < w.size(); ++i) {
    const float scale = first.scales[i / 5 % 4];
    CHECK(std::abs(rounded[i] - w[i]) <= 0.5001f * scale);
  }
  CHECK(first.scales[2] == 1);
  const Int8Weights second = int8_weights(shape, rounded.data());
  CHECK(second.values == first.values);
  for (std::size_t c = 0; c < 4; ++c) CHECK(second.scales[c] == Approx(first.scales[c]).epsilon(1e-6));
  // Denormal scales stay in range.
  std::vector<float> tiny(static_cast<std::size_t>(shape.size()), 1e-44f);
  for (const std::int8_t value : int8_weights(shape, tiny.data()).values) CHECK(value >= 1);
}

TEST_CASE("int8 gemm has the bits of packed gemm with the rounded weights") {
  test::for_instruction_sets([](const std::string& name) {
    for (const Index depth : {1, 17, 300, 2048, 2049, 5000})
      for (const Index n : {1, 16, 40})
        for (const Index rows : {1, 2, 33, 130}) {
          CAPTURE(name, depth, n, rows);
          const std::vector<float> w = random_numbers(depth * n, 1), bias = random_numbers(n, 2);
          std::vector<float> a = random_numbers(rows * depth, 3), residual = random_numbers(rows * n, 4);
          a.resize(a.size() + 16);
          residual.resize(residual.size() + 16);
          const Int8Weights small = int8_weights({.outer = depth, .channels = n}, w.data());
          std::vector<float> rounded(w.size());
          from_int8({.outer = depth, .channels = n}, small.values, small.scales, rounded.data());
          const PackedFinish finish{Clamp::relu, residual.data()};
          std::vector<float> wanted(static_cast<std::size_t>(rows * n)), one(wanted.size()), three(wanted.size());
          Parallel single(1), triple(3);
          packed_gemm(single, rows, a.data(), packed_weights(depth, n, rounded.data(), bias.data()), finish,
                      wanted.data());
          const PackedInt8 packed = packed_int8(depth, n, w.data(), bias.data());
          const AlignedFloats scratch = aligned_floats(int8_gemm_scratch(3));
          int8_gemm(single, rows, a.data(), packed, finish, one.data(), scratch.get());
          int8_gemm(triple, rows, a.data(), packed, finish, three.data(), scratch.get());
          CHECK(std::memcmp(one.data(), wanted.data(), 4 * one.size()) == 0);
          CHECK(std::memcmp(three.data(), wanted.data(), 4 * one.size()) == 0);
        }
  });
}
