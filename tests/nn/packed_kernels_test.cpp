// The kernels of compiled inference against the plain definitions, at odd sizes, on every instruction set.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "base/aligned.h"
#include "base/instruction_sets.h"
#include "nn/kernels/conv2d/conv2d.h"
#include "nn/kernels/conv2d/packed_conv2d.h"
#include "nn/kernels/depthwise/depthwise.h"
#include "nn/kernels/gemm.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "nn/kernels/packed/streamed_gemm.h"
#include "nn/kernels/pool/inference_pool.h"
#include "nn/kernels/pool/pool.h"
#include "nn/kernels/separable/fused_separable.h"
#include "nn/kernels/winograd/winograd.h"
#include "nn/numbers.h"
#include "nn/packed_numbers.h"

using namespace svnet;
using namespace svnet::kernels;
using namespace svnet::test;

TEST_CASE("packed gemm multiplies, adds bias and residual, and clamps") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (Index rows : {1, 5, 13, 100})
      for (Index n : {1, 16, 24, 47})
        for (Index k : {1, 30, 2100}) {
          INFO(isa << ": " << rows << "x" << k << " * " << k << "x" << n);
          const Numbers a(1, rows * k), w(2, k * n), bias(3, n), residual(4, rows * n);
          std::vector<double> expected(static_cast<std::size_t>(rows * n));
          gemm_reference<double>({.m = rows, .n = n, .k = k}, wide(a.get(), a.count).data(),
                                 wide(w.get(), w.count).data(), expected.data());
          const PackedWeights packed = packed_weights(k, n, w.get(), bias.get());
          const AlignedFloats c = scratch_memory(rows * n);
          packed_gemm(parallel, rows, a.get(), packed, {Clamp::relu6, residual.get()}, c.get());
          CHECK(distance(c.get(), expected, n, bias.get(), residual.get(), Clamp::relu6) <= 2e-6);
          packed_gemm(parallel, rows, a.get(), packed, {}, c.get());
          CHECK(distance(c.get(), expected, n, bias.get(), nullptr, Clamp::none) <= 2e-6);
        }
  });
}

TEST_CASE("NaN passes through the clamps of packed and separable kernels, on every instruction set") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    INFO(isa);
    const Window w = window(1, 5, 9, 16, 3, 1, Padding::same());
    const Index pixel = 2 * 9 + 4;
    Numbers x(1, w.positions() * w.c), pointwise(2, w.c * 20), taps(3, 9 * w.c), bias(4, 20);
    x.memory[pixel * w.c + 7] = NAN;
    const PackedWeights packed = packed_weights(w.c, 20, pointwise.get(), bias.get());
    for (Clamp clamp : {Clamp::none, Clamp::relu, Clamp::relu6}) {
      const AlignedFloats y = scratch_memory(w.positions() * 20);
      packed_gemm(parallel, w.positions(), x.get(), packed, {clamp}, y.get());
      for (Index p = 0; p < w.positions(); ++p) CHECK(std::isnan(y[p * 20 + 19]) == (p == pixel));
      DepthwiseTaps depthwise = depthwise_taps(3, 3, w.c, taps.get(), nullptr);
      depthwise.clamp = clamp;
      depthwise.relu_input = true;
      const AlignedFloats scratch = scratch_memory(separable_scratch(w, parallel.threads()));
      separable_conv2d(parallel, w, x.get(), depthwise, packed, {clamp}, y.get(), scratch.get());
      for (Index p = 0; p < w.positions(); ++p) {
        const bool near = std::abs(p / 9 - 2) <= 1 && std::abs(p % 9 - 4) <= 1;
        CHECK(std::isnan(y[p * 20]) == near);
      }
    }
  });
}

TEST_CASE("streamed gemm multiplies few rows by a large matrix") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (Index m : {1, 7, 32})
      for (Index n : {1, 40, 130, 256})
        for (Index k : {3, 128, 300}) {
          INFO(isa << ": " << m << "x" << k << " * " << k << "x" << n);
          const Numbers a(1, m * k), w(2, k * n), zeros(3, n);
          std::fill_n(zeros.memory.get(), n, 0.0f);
          std::vector<double> expected(static_cast<std::size_t>(m * n));
          gemm_reference<double>({.m = m, .n = n, .k = k}, wide(a.get(), a.count).data(), wide(w.get(), w.count).data(),
                                 expected.data());
          const AlignedFloats c = scratch_memory(m * n);
          streamed_gemm(parallel, {m, n, k}, a.get(), w.get(), c.get());
          CHECK(distance(c.get(), expected, n, zeros.get(), nullptr, Clamp::none) <= 2e-6);
        }
  });
}

TEST_CASE("a row of a packed product does not depend on the rows beside it") {
  Parallel parallel(2);
  const Index rows = 45, n = 40, k = 70;
  const Numbers a(1, rows * k), w(2, k * n);
  const PackedWeights packed = packed_weights(k, n, w.get(), nullptr);
  const AlignedFloats whole = scratch_memory(rows * n), one = scratch_memory(n);
  packed_gemm(parallel, rows, a.get(), packed, {}, whole.get());
  for (Index row = 0; row < rows; ++row) {
    packed_gemm(parallel, 1, a.get() + row * k, packed, {}, one.get());
    CHECK(std::equal(one.get(), one.get() + n, whole.get() + row * n));
  }
}

TEST_CASE("direct and Winograd convolutions agree with the definition") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w :
         {window(2, 9, 7, 3, 3, 1, Padding::same()), window(1, 11, 10, 5, 3, 2, Padding::valid()),
          window(1, 8, 9, 16, 5, 3, Padding::of(2, 1, 0, 3)), window(2, 6, 5, 16, 1, 2, Padding::same()),
          window(1, 13, 10, 16, 3, 1, Padding::same()), window(2, 4, 9, 48, 3, 1, Padding::valid()),
          window(2, 6, 50, 3, 3, 1, Padding::same()), window(1, 7, 101, 3, 3, 2, Padding::of(0, 1, 0, 1)),
          window(1, 5, 120, 20, 1, 2, Padding::same()), window(1, 2, 49, 2, 5, 1, Padding::of(2, 2, 2, 2))})
      for (Index k : {16, 20}) {
        INFO(isa << ": " << w.n << "x" << w.h << "x" << w.w << "x" << w.c << ", window " << w.kh << ", stride "
                 << w.stride_h << ", " << k << " filters");
        const Numbers x(1, w.n * w.h * w.w * w.c), weights(2, w.kh * w.kw * w.c * k), bias(3, k);
        std::vector<double> expected(static_cast<std::size_t>(w.positions() * k));
        conv2d_reference<double>({w, k}, wide(x.get(), x.count).data(), wide(weights.get(), weights.count).data(),
                                 expected.data());
        const AlignedFloats y = scratch_memory(w.positions() * k);
        const PackedWeights packed = packed_weights(w.kh * w.kw * w.c, k, weights.get(), bias.get());
        const AlignedFloats scratch = scratch_memory(packed_conv2d_scratch(w, parallel.threads()));
        packed_conv2d(parallel, w, x.get(), packed, {Clamp::relu}, y.get(), scratch.get());
        CHECK(distance(y.get(), expected, k, bias.get(), nullptr, Clamp::relu) <= 1e-6);
        if (!winograd_fits(w, k)) continue;
        const WinogradWeights winograd = winograd_weights(w.c, k, weights.get(), bias.get());
        const AlignedFloats points = scratch_memory(winograd_scratch(w, winograd, parallel.threads()));
        winograd_conv2d(parallel, w, x.get(), winograd, {Clamp::relu, false}, y.get(), points.get());
        CHECK(distance(y.get(), expected, k, bias.get(), nullptr, Clamp::relu) <= 5e-6);
      }
  });
}

TEST_CASE("Winograd with many channels runs by channels, pools, and gives the same bits for any number of threads") {
  for_instruction_sets([&](const std::string& isa) {
    INFO(isa);
    const Index c = 192, k = 192;  // more pairs of channels than are kept transformed
    const Window w = window(3, 10, 11, c, 3, 1, Padding::same());
    const Numbers x(1, w.n * w.h * w.w * c), weights(2, 9 * c * k), bias(3, k);
    const WinogradWeights winograd = winograd_weights(c, k, weights.get(), bias.get());
    REQUIRE_FALSE(winograd.transformed);
    std::vector<double> expected(static_cast<std::size_t>(w.positions() * k));
    conv2d_reference<double>({w, k}, wide(x.get(), x.count).data(), wide(weights.get(), weights.count).data(),
                             expected.data());
    std::vector<float> first;
    for (int threads : {1, 2, 5}) {
      Parallel parallel(threads);
      const AlignedFloats y = scratch_memory(w.positions() * k);
      const AlignedFloats scratch = scratch_memory(winograd_scratch(w, winograd, threads));
      winograd_conv2d(parallel, w, x.get(), winograd, {Clamp::relu, false}, y.get(), scratch.get());
      CHECK(distance(y.get(), expected, k, bias.get(), nullptr, Clamp::relu) <= 5e-6);
      if (first.empty()) first.assign(y.get(), y.get() + w.positions() * k);
      CHECK(std::equal(first.begin(), first.end(), y.get()));
      const Index oh = w.oh / 2, ow = w.ow / 2;
      const AlignedFloats pooled = scratch_memory(w.n * oh * ow * k);
      winograd_conv2d(parallel, w, x.get(), winograd, {Clamp::relu, true}, pooled.get(), scratch.get());
      bool same = true;
      for (Index n = 0; n < w.n; ++n)
        for (Index i = 0; i < oh; ++i)
          for (Index j = 0; j < ow; ++j)
            for (Index channel = 0; channel < k; ++channel) {
              const auto at = [&](Index row, Index column) {
                return first[static_cast<std::size_t>(((n * w.oh + row) * w.ow + column) * k + channel)];
              };
              const float largest = std::max(std::max(at(2 * i, 2 * j), at(2 * i, 2 * j + 1)),
                                             std::max(at(2 * i + 1, 2 * j), at(2 * i + 1, 2 * j + 1)));
              same = same && largest == pooled[((n * oh + i) * ow + j) * k + channel];
            }
      CHECK(same);
    }
  });
}

TEST_CASE("Winograd's gradients agree with the definition") {
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w :
         {window(2, 9, 7, 16, 3, 1, Padding::same()), window(1, 12, 10, 48, 3, 1, Padding::valid()),
          window(1, 5, 6, 32, 3, 1, Padding::of(2, 0, 1, 3)), window(5, 29, 31, 16, 3, 1, Padding::same())}) {
      const Index k = 32, c = w.c;
      INFO(isa << ": " << w.n << "x" << w.h << "x" << w.w << "x" << c);
      const Numbers x(1, w.n * w.h * w.w * c), weights(2, 9 * c * k), dy(3, w.positions() * k), zeros(4, c + k);
      std::fill_n(zeros.memory.get(), c + k, 0.0f);
      std::vector<double> dx(static_cast<std::size_t>(x.count)), dw(static_cast<std::size_t>(weights.count));
      conv2d_input_gradient_reference<double>({w, k}, wide(dy.get(), dy.count).data(),
                                              wide(weights.get(), weights.count).data(), dx.data());
      conv2d_weight_gradient_reference<double>({w, k}, wide(x.get(), x.count).data(), wide(dy.get(), dy.count).data(),
                                               dw.data());
      std::vector<float> first;
      for (int threads : {1, 2, 5}) {
        Parallel parallel(threads);
        const Window flipped = w.input_gradient(k);
        const WinogradWeights flipped_weights = winograd_flipped_weights(c, k, weights.get());
        const AlignedFloats found_dx = scratch_memory(x.count), found_dw = scratch_memory(weights.count);
        const AlignedFloats scratch = scratch_memory(winograd_scratch(flipped, flipped_weights, threads));
        winograd_conv2d(parallel, flipped, dy.get(), flipped_weights, {}, found_dx.get(), scratch.get());
        CHECK(distance(found_dx.get(), dx, c, zeros.get(), nullptr, Clamp::none) <= 1e-5);
        const AlignedFloats points = scratch_memory(winograd_weight_gradient_scratch(w, k));
        winograd_weight_gradient(parallel, w, k, x.get(), dy.get(), found_dw.get(), points.get());
        CHECK(distance(found_dw.get(), dw, k, zeros.get(), nullptr, Clamp::none) <= 1e-5);
        if (first.empty()) first.assign(found_dw.get(), found_dw.get() + weights.count);
        CHECK(std::equal(first.begin(), first.end(), found_dw.get()));
      }
    }
  });
}

TEST_CASE("separable convolutions agree with their two halves") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w :
         {window(2, 9, 12, 24, 3, 1, Padding::same()), window(1, 10, 11, 40, 3, 2, Padding::of(0, 1, 0, 1)),
          window(1, 7, 7, 16, 5, 1, Padding::valid()), window(3, 3, 2, 5, 3, 1, Padding::same()),
          window(2, 5, 4, 21, 3, 1, Padding::same()), window(2, 1, 6, 16, 3, 1, Padding::same()),
          window(1, 2, 23, 80, 3, 1, Padding::same()), window(2, 5, 7, 33, 3, 2, Padding::same()),
          window(1, 6, 19, 70, 3, 2, Padding::same()), window(1, 6, 13, 18, 3, 2, Padding::valid()),
          window(1, 8, 9, 16, 3, 1, Padding::of(1, 1, 0, 1)), window(1, 6, 9, 18, 3, 2, Padding::of(0, 0, 2, 0)),
          window(1, 6, 9, 18, 3, 2, Padding::of(0, 0, 0, 2)), window(1, 6, 9, 18, 3, 1, Padding::of(2, 2, 2, 2))})
      for (bool relu : {false, true}) {
        const Index k = 19, c = w.c;
        INFO(isa << ": " << w.n << "x" << w.h << "x" << w.w << "x" << c << ", stride " << w.stride_h << ", relu "
                 << relu);
        const Numbers x(1, w.n * w.h * w.w * c), taps(2, w.kh * w.kw * c), shift(5, c), pointwise(3, c * k), bias(4, k);
        std::vector<double> input = wide(x.get(), x.count), between(static_cast<std::size_t>(w.positions() * c));
        if (relu)
          for (double& v : input) v = std::max(v, 0.0);
        depthwise_reference<double>(parallel, {w, 1}, input.data(), wide(taps.get(), taps.count).data(),
                                    between.data());
        for (std::size_t i = 0; i < between.size(); ++i)
          between[i] = clamped(between[i] + shift.get()[static_cast<Index>(i) % c], Clamp::relu6);
        std::vector<double> expected(static_cast<std::size_t>(w.positions() * k));
        gemm_reference<double>({.m = w.positions(), .n = k, .k = c}, between.data(),
                               wide(pointwise.get(), pointwise.count).data(), expected.data());
        DepthwiseTaps depthwise = depthwise_taps(w.kh, w.kw, c, taps.get(), shift.get());
        depthwise.relu_input = relu;
        depthwise.clamp = Clamp::relu6;
        const Numbers residual(6, w.positions() * k);
        const AlignedFloats y = scratch_memory(w.positions() * k);
        const AlignedFloats scratch = scratch_memory(separable_scratch(w, parallel.threads()));
        separable_conv2d(parallel, w, x.get(), depthwise, packed_weights(c, k, pointwise.get(), bias.get()),
                         {Clamp::relu, residual.get()}, y.get(), scratch.get());
        CHECK(distance(y.get(), expected, k, bias.get(), residual.get(), Clamp::relu) <= 1e-6);
      }
  });
}

TEST_CASE("a separable convolution that makes its image row by row gives the bits of one that reads it") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w : {window(2, 29, 30, 24, 3, 1, Padding::same()), window(1, 57, 57, 40, 3, 2, Padding::same()),
                            window(1, 40, 28, 16, 3, 2, Padding::of(0, 1, 0, 1)),
                            window(1, 3, 5, 16, 3, 1, Padding::same()), window(1, 31, 300, 5, 5, 1, Padding::valid())})
      for (const Precision precision :
           machine_has_bf16() ? std::vector{Precision::f32, Precision::bf16} : std::vector{Precision::f32}) {
        INFO(isa << ": " << w.n << "x" << w.h << "x" << w.w << "x" << w.c << ", stride " << w.stride_h << ", "
                 << (precision == Precision::bf16 ? "bf16" : "f32"));
        const Index k = 11, filters = 19, pixels = w.n * w.h * w.w;
        const Numbers x(1, pixels * k), taps(2, w.kh * w.kw * w.c), shift(3, w.c), first(4, k * w.c),
            first_bias(5, w.c), second(6, w.c * filters), second_bias(7, filters), residual(8, w.positions() * filters);
        const PackedWeights expansion = packed_weights(k, w.c, first.get(), first_bias.get(), precision);
        const PackedWeights pointwise = packed_weights(w.c, filters, second.get(), second_bias.get(), precision);
        DepthwiseTaps depthwise = depthwise_taps(w.kh, w.kw, w.c, taps.get(), shift.get());
        depthwise.clamp = Clamp::relu6;
        const PackedFinish finish{Clamp::none, residual.get()};
        const AlignedFloats image = scratch_memory(pixels * w.c), expected = scratch_memory(w.positions() * filters),
                            actual = scratch_memory(w.positions() * filters);
        const AlignedFloats rounded = scratch_memory(packed_gemm_scratch(pixels, k, precision, parallel.threads()));
        packed_gemm(parallel, pixels, x.get(), expansion, {Clamp::relu}, image.get(), rounded.get());
        const AlignedFloats whole = scratch_memory(separable_scratch(w, parallel.threads(), precision));
        separable_conv2d(parallel, w, image.get(), depthwise, pointwise, finish, expected.get(), whole.get());
        const AlignedFloats rows = scratch_memory(expanded_separable_scratch(w, parallel.threads(), k, precision));
        expanded_separable_conv2d(parallel, w, x.get(), expansion, Clamp::relu, depthwise, pointwise, finish,
                                  actual.get(), rows.get());
        CHECK(std::equal(expected.get(), expected.get() + w.positions() * filters, actual.get()));
      }
  });
}

TEST_CASE("a separable convolution that is pooled strip by strip gives the bits of one that is pooled as a whole") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w : {window(2, 31, 30, 24, 3, 1, Padding::same()), window(1, 9, 57, 40, 3, 2, Padding::same()),
                            window(1, 3, 5, 16, 3, 1, Padding::same())})
      for (const Index kernel : {2, 3}) {
        const Index filters = 19;
        const Window pool = window(w.n, w.oh, w.ow, filters, kernel, 2, Padding::same());
        INFO(isa << ": " << w.n << "x" << w.h << "x" << w.w << "x" << w.c << ", pool " << kernel);
        Numbers x(1, w.n * w.h * w.w * w.c), taps(2, w.kh * w.kw * w.c), second(3, w.c * filters), bias(4, filters);
        x.memory[w.c * (w.w + 1)] = NAN;
        const PackedWeights pointwise = packed_weights(w.c, filters, second.get(), bias.get());
        DepthwiseTaps depthwise = depthwise_taps(w.kh, w.kw, w.c, taps.get(), nullptr);
        depthwise.relu_input = true;
        const AlignedFloats between = scratch_memory(w.positions() * filters),
                            expected = scratch_memory(pool.positions() * filters),
                            actual = scratch_memory(pool.positions() * filters),
                            whole = scratch_memory(separable_scratch(w, parallel.threads())),
                            strips = scratch_memory(separable_max_pool_scratch(w, pool, parallel.threads()));
        separable_conv2d(parallel, w, x.get(), depthwise, pointwise, {Clamp::none, nullptr}, between.get(),
                         whole.get());
        max_pool_inference(parallel, pool, between.get(), expected.get());
        separable_max_pool(parallel, w, x.get(), depthwise, pointwise, Clamp::none, pool, actual.get(), strips.get());
        CHECK(std::memcmp(expected.get(), actual.get(),
                          sizeof(float) * static_cast<std::size_t>(pool.positions() * filters)) == 0);
      }
  });
}

TEST_CASE("pooling for inference gives the values of pooling for training") {
  Parallel parallel(2);
  for_instruction_sets([&](const std::string& isa) {
    for (const Window& w : {window(2, 9, 7, 19, 3, 2, Padding::same()), window(1, 8, 8, 16, 2, 2, Padding::valid()),
                            window(1, 5, 4, 3, 3, 1, Padding::of(2, 2, 2, 2))}) {
      INFO(isa << ": " << w.h << "x" << w.w << "x" << w.c);
      Numbers x(1, w.n * w.h * w.w * w.c);
      x.memory[7] = NAN;
      const auto count = static_cast<std::size_t>(w.positions() * w.c);
      std::vector<float> expected(count), actual(count);
      std::vector<std::int64_t> source(count);
      const auto same = [&] {
        for (std::size_t i = 0; i < count; ++i)
          if (!(expected[i] == Approx(actual[i]).epsilon(1e-6).margin(1e-7) ||
                (std::isnan(expected[i]) && std::isnan(actual[i]))))
            return false;
        return true;
      };
      max_pool<float>(parallel, w, x.get(), expected.data(), source.data());
      max_pool_inference(parallel, w, x.get(), actual.data());
      CHECK(same());
      average_pool<float>(parallel, w, x.get(), expected.data());
      average_pool_inference(parallel, w, x.get(), actual.data());
      CHECK(same());
    }
  });
}
