// Products of bytes against plain loops over whole numbers, bit by bit.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/instruction_sets.h"
#include "nn/kernels/packed/int8_tile.h"
#include "nn/kernels/packed/packed_gemm.h"
#include "nn/kernels/separable/fused_separable.h"
#include "nn/packed_numbers.h"

using namespace svnet;
using namespace svnet::kernels;
using namespace svnet::test;

namespace {

/// Ranges that cover the middle of what `Numbers` draws, so that some inputs are out of range. Every seventh channel is
/// 0 throughout, every fifth is never negative.
ChannelRanges some_ranges(Index channels) {
  ChannelRanges ranges;
  for (Index i = 0; i < channels; ++i) {
    const float width = i % 7 == 6 ? 0.0f : 0.4f + 0.05f * static_cast<float>(i % 11);
    ranges.low.push_back(i % 5 == 4 ? 0.0f : -width);
    ranges.high.push_back(1.3f * width);
    ranges.mean.push_back(0.1f * width);
  }
  return ranges;
}

int byte_of(float x, float factor, float zero) {
  const float y = x * factor + zero;
  return y > 0 ? static_cast<int>(std::nearbyint(std::min(y, 255.0f))) : 0;
}

int weight_at(const PackedWeights& w, Index i, Index column) {
  const auto* bytes = reinterpret_cast<const std::int8_t*>(w.panel(column / kPanel));
  return bytes[(i / 4 * kPanel + column % kPanel) * 4 + i % 4];
}

/// What the product of the bytes (rows, depth) must be.
std::vector<float> product_of(Index rows, const std::vector<int>& bytes, const PackedWeights& w, const float* residual,
                              Clamp clamp) {
  std::vector<float> c;
  for (Index row = 0; row < rows; ++row)
    for (Index column = 0; column < w.n; ++column) {
      std::int64_t sum = w.start[static_cast<std::size_t>(column)];
      for (Index i = 0; i < w.depth; ++i)
        sum += bytes[static_cast<std::size_t>(row * w.depth + i)] * weight_at(w, i, column);
      REQUIRE(std::abs(sum) <= std::numeric_limits<std::int32_t>::max());
      const float scaled = static_cast<float>(static_cast<std::int32_t>(sum)) * w.scale.get()[column];
      float y = scaled + w.bias.get()[column];
      if (residual != nullptr) y += residual[row * w.n + column];
      c.push_back(range_of(clamp).clamped(y));
    }
  return c;
}

std::vector<int> bytes_of(Index rows, const float* a, const PackedWeights& w) {
  std::vector<int> bytes;
  for (Index i = 0; i < rows * w.depth; ++i)
    bytes.push_back(byte_of(a[i], w.input.factor.get()[i % w.depth], w.input.zero.get()[i % w.depth]));
  return bytes;
}

bool same_bits(const float* a, const std::vector<float>& b) {
  return std::memcmp(a, b.data(), b.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_CASE("products of bytes have the bits of plain sums, for every instruction set and number of threads") {
  for (const Index rows : {1, 5, 13, 100})
    for (const Index n : {1, 16, 24, 47, 64})
      for (const Index k : {1, 3, 4, 31, 100, 1500}) {
        INFO(rows << "x" << k << " * " << k << "x" << n);
        const Numbers a(1, rows * k), w(2, k * n), bias(3, n), residual(4, rows * n);
        const PackedWeights packed = packed_int8_weights(k, n, w.get(), bias.get(), some_ranges(k));
        const std::vector<int> bytes = bytes_of(rows, a.get(), packed);
        const std::vector<float> plain = product_of(rows, bytes, packed, nullptr, Clamp::none),
                                 finished = product_of(rows, bytes, packed, residual.get(), Clamp::relu6);
        const AlignedFloats c = scratch_memory(rows * n);
        const AlignedFloats scratch = scratch_memory(packed_gemm_scratch(rows, k, Precision::int8, 8));
        for_instruction_sets([&](const std::string& name) {
          INFO(name);
          for (const int threads : {1, 2, 8}) {
            Parallel parallel(threads);
            packed_gemm(parallel, rows, a.get(), packed, {}, c.get(), scratch.get());
            CHECK(same_bits(c.get(), plain));
            packed_gemm(parallel, rows, a.get(), packed, {Clamp::relu6, residual.get()}, c.get(), scratch.get());
            CHECK(same_bits(c.get(), finished));
          }
        });
      }
}

TEST_CASE("the largest bytes and weights do not saturate, with and without VNNI") {
  const Index rows = 14, k = 5000, n = 32, stride = quads(k);
  for (const float sign : {1.0f, -1.0f}) {
    const std::vector<float> w(static_cast<std::size_t>(k * n), sign), bias(static_cast<std::size_t>(n));
    const ChannelRanges ranges{std::vector<float>(static_cast<std::size_t>(k), 0.0f),
                               std::vector<float>(static_cast<std::size_t>(k), 1.0f),
                               std::vector<float>(static_cast<std::size_t>(k), 0.5f)};
    const PackedWeights packed = packed_int8_weights(k, n, w.data(), bias.data(), ranges);
    REQUIRE(weight_at(packed, 17, 3) == static_cast<int>(sign) * kLargestByteWeight);
    const AlignedFloats a = aligned_floats(rows * stride), c = scratch_memory(rows * n);
    std::memset(a.get(), 0xff, static_cast<std::size_t>(rows * stride) * 4);
    const std::vector<float> wanted =
        product_of(rows, std::vector<int>(static_cast<std::size_t>(rows * k), 255), packed, nullptr, Clamp::none);
    for_instruction_sets([&](const std::string& name) {
      for (const TileKernels& kernels : {int8_tiles(), int8_tiles_without_vnni()}) {
        INFO(name << ", rows of a tile " << kernels.rows);
        const TileFinish finish{.bias = packed.bias.get(),
                                .residual = nullptr,
                                .residual_stride = 0,
                                .low = -INFINITY,
                                .high = INFINITY,
                                .start = packed.start.data(),
                                .scale = packed.scale.get()};
        for (Index p = 0; p < panels(n); p += kernels.panels) {
          TileFinish here = finish;
          here.bias += p * kPanel, here.start += p * kPanel, here.scale += p * kPanel;
          multiply_panels(kernels, kernels.panels, rows, {a.get(), stride, kPanel}, stride, packed.panel(p),
                          stride * kPanel, {.c = c.get() + p * kPanel, .stride = n, .finish = &here});
        }
        CHECK(same_bits(c.get(), wanted));
      }
    });
  }
  CHECK_THROWS_WITH(packed_int8_weights(kMostByteDepth + 1, 1, nullptr, nullptr, {}),
                    Catch::Contains("int8 takes sums of at most"));
}

TEST_CASE("bytes of rows that lie in runs end with their row") {
  // A window of three rows of an image: three runs, whose last vector would reach into the next row of bytes.
  for (const Index channels : {5, 14, 27, 35, 71}) {
    const Index rows = 50, run = 3 * channels, k = 3 * run, across = 3 * channels + rows * channels;
    const Index stride = packed_row_stride(quads(k));
    const ByteInput input = byte_input(k, some_ranges(channels));
    const Numbers image(5, 3 * across + kPanel);
    for_instruction_sets([&](const std::string& name) {
      INFO(name << ", " << channels << " channels");
      const AlignedFloats quad = aligned_floats(rows * stride + 1);
      std::memset(quad.get(), 0x5a, static_cast<std::size_t>(rows * stride + 1) * sizeof(float));
      round_to_quads(rows, {image.get(), channels, across, run}, k, input, quad.get(), stride);
      Index wrong = 0;
      for (Index row = 0; row < rows; ++row)
        for (Index i = 0; i < k; ++i) {
          if (input.factor.get()[i] == 0) continue;
          const float x = image.get()[i / run * across + row * channels + i % run];
          const auto* bytes = reinterpret_cast<const std::uint8_t*>(quad.get() + row * stride);
          wrong += bytes[i] != byte_of(x, input.factor.get()[i], input.zero.get()[i]) ? 1 : 0;
        }
      CHECK(wrong == 0);
      const auto* after = reinterpret_cast<const std::uint8_t*>(quad.get() + rows * stride);
      CHECK(std::count(after, after + 4, 0x5a) == 4);
    });
  }
}

TEST_CASE("inputs outside their range take its limits, and NaN and infinity do not leave it") {
  const Index k = 19;
  const ChannelRanges ranges = some_ranges(k);
  const ByteInput input = byte_input(k, ranges);
  const AlignedFloats a = scratch_memory(k), quad = scratch_memory(packed_row_stride(quads(k)));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(quad.get());
  for_instruction_sets([&](const std::string& name) {
    for (const float value : {0.0f, 0.2f, -0.2f, 1e9f, -1e9f, 3e38f, INFINITY, -INFINITY, std::nanf("")}) {
      INFO(name << " " << value);
      std::fill_n(a.get(), k, value);
      round_to_quads(1, {a.get(), k, kPanel}, k, input, quad.get(), packed_row_stride(quads(k)));
      for (Index i = 0; i < k; ++i) {
        if (input.factor.get()[i] == 0) continue;  // its weights are 0
        CHECK(bytes[i] == byte_of(value, input.factor.get()[i], input.zero.get()[i]));
        if (value == 0) CHECK(static_cast<float>(bytes[i]) == input.zero.get()[i]);
      }
    }
  });
  CHECK(input.factor.get()[6] == 0);
}

TEST_CASE("rounded weights are within half a step of the exact ones, and the bias takes away their mean error") {
  const Index k = 70, n = 20;
  const Numbers w(1, k * n), bias(2, n);
  const ChannelRanges ranges = some_ranges(k);
  const PackedWeights packed = packed_int8_weights(k, n, w.get(), bias.get(), ranges);
  for (Index column = 0; column < n; ++column) {
    double drift = 0;
    int largest = 0;
    for (Index i = 0; i < k; ++i) {
      const double factor = packed.input.factor.get()[i], scale = packed.scale.get()[column];
      const int rounded = weight_at(packed, i, column);
      largest = std::max(largest, std::abs(rounded));
      if (factor == 0) {
        CHECK(rounded == 0);
        continue;
      }
      const double exact = w.get()[i * n + column] / factor / scale;
      CHECK(std::abs(rounded - exact) <= 0.5001);
      drift += (rounded - exact) * scale * factor * ranges.mean[static_cast<std::size_t>(i)];
    }
    CHECK(largest == kLargestByteWeight);
    CHECK(packed.bias.get()[column] == Approx(bias.get()[column] - drift).margin(1e-6));
  }
}

TEST_CASE("separable convolutions in int8 have the bits of plain sums of the rounded values between their halves") {
  for (const Window& w :
       {window(2, 9, 12, 24, 3, 1, Padding::same()), window(1, 10, 11, 37, 3, 2, Padding::of(0, 1, 0, 1)),
        window(1, 3, 3, 5, 3, 1, Padding::same()), window(2, 7, 6, 70, 5, 1, Padding::same())})
    for (const bool relu : {false, true}) {
      const Index k = 19, c = w.c, rows = w.positions();
      INFO(w.h << "x" << w.w << "x" << c << " relu " << relu);
      const Numbers x(1, w.n * w.h * w.w * c), taps(2, w.kh * w.kw * c), pointwise(3, c * k), shift(4, c), bias(5, k),
          residual(6, rows * k);
      const PackedWeights packed = packed_int8_weights(c, k, pointwise.get(), bias.get(), some_ranges(c));
      DepthwiseTaps depthwise = depthwise_taps(w.kh, w.kw, c, taps.get(), shift.get());
      depthwise.relu_input = relu;
      round_taps(packed.input, depthwise);
      const AlignedFloats between = scratch_memory(rows * panels(c) * kPanel), y = scratch_memory(rows * k);
      const AlignedFloats scratch = scratch_memory(separable_scratch(w, 8, Precision::int8));
      for_instruction_sets([&](const std::string& name) {
        INFO(name);
        depthwise_rows(w, depthwise, x.get(), 0, rows, between.get());
        std::vector<int> bytes;
        for (Index row = 0; row < rows; ++row)
          for (Index i = 0; i < c; ++i)
            bytes.push_back(byte_of(between.get()[(i / kPanel * rows + row) * kPanel + i % kPanel], 1, 0));
        const std::vector<float> wanted = product_of(rows, bytes, packed, residual.get(), Clamp::relu);
        for (const int threads : {1, 2, 8}) {
          Parallel parallel(threads);
          separable_conv2d(parallel, w, x.get(), depthwise, packed, {Clamp::relu, residual.get()}, y.get(),
                           scratch.get());
          CHECK(same_bits(y.get(), wanted));
        }
      });
    }
}
