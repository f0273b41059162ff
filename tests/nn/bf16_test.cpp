// Products in bf16 against sums in f64 of the rounded operands.
#include "base/bf16.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/instruction_sets.h"
#include "base/rounded_to_bf16.h"
#include "nn/kernels/conv2d/conv2d.h"
#include "nn/kernels/conv2d/packed_conv2d.h"
#include "nn/kernels/depthwise/depthwise.h"
#include "nn/kernels/gemm.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/separable/separable.h"
#include "nn/packed_numbers.h"

using namespace svnet;
using namespace svnet::kernels;
using namespace svnet::test;

namespace {

std::vector<double> rounded(const Numbers& x) {
  std::vector<double> result = wide(x.get(), x.count);
  for (double& v : result) v = rounded_to_bf16(v);
  return result;
}

bool lacks_bf16() {
  if (!machine_has_bf16()) WARN("this processor has no AVX512-BF16: nothing is tested");
  return !machine_has_bf16();
}

}  // namespace

TEST_CASE("neighbours are rounded to a pair, and a zero stands beside the last of an odd number") {
  if (lacks_bf16()) return;
  const Numbers drawn(1, 7);
  const AlignedFloats pairs_of = scratch_memory(pairs(7));
  round_to_pairs(1, {drawn.get(), 7, kPanel}, 7, pairs_of.get(), pairs(7));
  for (Index i = 0; i < 8; ++i) {
    const auto pair = std::bit_cast<std::uint32_t>(pairs_of.get()[i / 2]);
    CHECK((i % 2 == 0 ? pair & 0xffff : pair >> 16) == (i < 7 ? bf16_bits(drawn.get()[i]) : 0));
  }
}

TEST_CASE("packed gemm in bf16 multiplies rounded operands, adds bias and residual, and clamps") {
  if (lacks_bf16()) return;
  Parallel parallel(2);
  for (Index rows : {1, 5, 13, 100})
    for (Index n : {1, 16, 24, 47, 64})
      for (Index k : {1, 2, 31, 100, 4300}) {
        INFO(rows << "x" << k << " * " << k << "x" << n);
        const Numbers a(1, rows * k), w(2, k * n), bias(3, n), residual(4, rows * n);
        std::vector<double> expected(static_cast<std::size_t>(rows * n));
        gemm_reference<double>({.m = rows, .n = n, .k = k}, rounded(a).data(), rounded(w).data(), expected.data());
        const PackedWeights packed = packed_weights(k, n, w.get(), bias.get(), Precision::bf16);
        const AlignedFloats c = scratch_memory(rows * n), first = scratch_memory(rows * n);
        const AlignedFloats scratch = scratch_memory(packed_gemm_scratch(rows, k, Precision::bf16, 2));
        const auto product = [&](const PackedFinish& finish) {
          packed_gemm(parallel, rows, a.get(), packed, finish, c.get(), scratch.get());
        };
        product({Clamp::relu6, residual.get()});
        CHECK(distance(c.get(), expected, n, bias.get(), residual.get(), Clamp::relu6) <= 2e-6);
        product({});
        CHECK(distance(c.get(), expected, n, bias.get(), nullptr, Clamp::none) <= 2e-6);
        std::copy_n(c.get(), rows * n, first.get());
        for_instruction_sets([&](const std::string& driver) {
          INFO(driver);
          product({});
          CHECK(std::equal(c.get(), c.get() + rows * n, first.get()));
        });
        for (Index row = 0; row < rows; ++row) {
          packed_gemm(parallel, 1, a.get() + row * k, packed, {}, c.get(), scratch.get());
          REQUIRE(std::equal(c.get(), c.get() + n, first.get() + row * n));
        }
      }
}

TEST_CASE("convolutions in bf16 read windows in place, in rows and gathered") {
  if (lacks_bf16()) return;
  Parallel parallel(2);
  for (const Window& w :
       {window(2, 9, 7, 5, 3, 1, Padding::same()), window(1, 11, 12, 20, 3, 2, Padding::of(0, 1, 0, 1)),
        window(3, 6, 5, 33, 1, 1, Padding::valid()), window(1, 5, 60, 3, 3, 1, Padding::same()),
        window(1, 4, 101, 17, 2, 2, Padding::valid())}) {
    const Index k = 19, depth = w.kh * w.kw * w.c;
    INFO(w.h << "x" << w.w << "x" << w.c << ", kernel " << w.kh << ", stride " << w.stride_h);
    const Numbers x(1, w.n * w.h * w.w * w.c), weights(2, depth * k), bias(3, k);
    std::vector<double> expected(static_cast<std::size_t>(w.positions() * k));
    conv2d_reference<double>({w, k}, rounded(x).data(), rounded(weights).data(), expected.data());
    const AlignedFloats y = scratch_memory(w.positions() * k);
    const AlignedFloats scratch = scratch_memory(packed_conv2d_scratch(w, parallel.threads(), Precision::bf16));
    packed_conv2d(parallel, w, x.get(), packed_weights(depth, k, weights.get(), bias.get(), Precision::bf16),
                  {Clamp::relu}, y.get(), scratch.get());
    CHECK(distance(y.get(), expected, k, bias.get(), nullptr, Clamp::relu) <= 2e-6);
  }
}

TEST_CASE("separable convolutions in bf16 round the values between their halves; NaN stays NaN") {
  if (lacks_bf16()) return;
  Parallel parallel(2);
  for (const Window& w :
       {window(2, 9, 12, 24, 3, 1, Padding::same()), window(1, 10, 11, 37, 3, 2, Padding::of(0, 1, 0, 1))}) {
    const Index k = 19, c = w.c;
    INFO(w.h << "x" << w.w << "x" << c);
    Numbers x(1, w.n * w.h * w.w * c);
    const Numbers taps(2, w.kh * w.kw * c), pointwise(3, c * k), bias(4, k), residual(5, w.positions() * k);
    // A tap in each channel, so that the depthwise half is exact.
    for (Index i = 0; i < taps.count; ++i) taps.memory[i] = i / c == 4 ? 0.5f : 0.0f;
    std::vector<double> between(static_cast<std::size_t>(w.positions() * c));
    depthwise_reference<double>(parallel, {w, 1}, wide(x.get(), x.count).data(), wide(taps.get(), taps.count).data(),
                                between.data());
    for (double& v : between) v = rounded_to_bf16(v);
    std::vector<double> expected(static_cast<std::size_t>(w.positions() * k));
    gemm_reference<double>({.m = w.positions(), .n = k, .k = c}, between.data(), rounded(pointwise).data(),
                           expected.data());
    const DepthwiseTaps depthwise = depthwise_taps(w.kh, w.kw, c, taps.get(), nullptr);
    const PackedWeights packed = packed_weights(c, k, pointwise.get(), bias.get(), Precision::bf16);
    const AlignedFloats y = scratch_memory(w.positions() * k);
    const AlignedFloats scratch = scratch_memory(separable_scratch(w, parallel.threads(), Precision::bf16));
    const auto run = [&](Clamp clamp) {
      separable_conv2d(parallel, w, x.get(), depthwise, packed, {clamp, residual.get()}, y.get(), scratch.get());
    };
    run(Clamp::relu6);
    CHECK(distance(y.get(), expected, k, bias.get(), residual.get(), Clamp::relu6) <= 2e-6);
    x.memory[x.count / 2] = NAN;
    for (const Clamp clamp : {Clamp::none, Clamp::relu, Clamp::relu6}) {
      run(clamp);
      CHECK(std::count_if(y.get(), y.get() + w.positions() * k, [](float v) { return std::isnan(v); }) >= k);
    }
  }
}
