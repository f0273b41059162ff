#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/instruction_sets.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;
using kernels::Clamp;

namespace {

constexpr Clamp kClamps[] = {Clamp::none, Clamp::relu, Clamp::relu6};

double clamped(double value, Clamp clamp) {
  if (clamp != Clamp::none && value < 0) return 0;
  return clamp == Clamp::relu6 && value > 6 ? 6 : value;
}

template <class T>
void check_scale_shift(Index rows, Index channels, Clamp clamp) {
  const Tensor x = random_tensor({rows, channels}, 1, kDType<T>, -4, 4),
               scale = random_tensor({channels}, 2, kDType<T>, -3, 3), shift = random_tensor({channels}, 3, kDType<T>);
  Tensor truth = Tensor::empty(x.shape(), DType::f64), magnitude = truth.clone();
  for (Index i = 0; i < x.size(); ++i) {
    const Index c = i % channels;
    const double product = static_cast<double>(x.data<T>()[i]) * scale.data<T>()[c];
    truth.data<double>()[i] = clamped(product + shift.data<T>()[c], clamp);
    magnitude.data<double>()[i] = std::abs(product) + std::abs(static_cast<double>(shift.data<T>()[c]));
  }
  INFO(rows << "x" << channels << ", clamp " << static_cast<int>(clamp) << ", " << name_of(kDType<T>));
  Parallel& parallel = Parallel::shared();
  Tensor y = Tensor::full(x.shape(), 7, kDType<T>);
  kernels::scale_shift(parallel, {rows, channels}, x.data<T>(), scale.data<T>(), shift.data<T>(), clamp, y.data<T>());
  CHECK(error_in_epsilons(y, truth, magnitude) <= 1);
  Tensor in_place = x.clone();
  kernels::scale_shift(parallel, {rows, channels}, in_place.data<T>(), scale.data<T>(), shift.data<T>(), clamp,
                       in_place.data<T>());
  CHECK(same_bits(in_place, y));
  kernels::scale_shift_reference(parallel, {rows, channels}, x.data<T>(), scale.data<T>(), shift.data<T>(), clamp,
                                 y.data<T>());
  CHECK(error_in_epsilons(y, truth, magnitude) <= 1);
}

}  // namespace

TEST_CASE("scale and shift follow the definition for every number of channels, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    for (Clamp clamp : kClamps) {
      for (Index channels = 1; channels <= 70; ++channels) check_scale_shift<float>(5, channels, clamp);
      check_scale_shift<float>(1031, 33, clamp);
    }
  });
  for (Clamp clamp : kClamps) check_scale_shift<double>(131, 7, clamp);
}

TEST_CASE("NaN passes through scale and shift at every channel, with any clamp, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    constexpr Index kChannels = 39;  // full vectors and a tail
    const Tensor ones = Tensor::full({kChannels}, 1);
    for (Clamp clamp : kClamps)
      for (Index at = 0; at < kChannels; ++at) {
        Tensor x = Tensor::full({kChannels}, 2), y = x.clone(), reference = x.clone();
        x.data<float>()[at] = std::numeric_limits<float>::quiet_NaN();
        kernels::scale_shift(Parallel::shared(), {1, kChannels}, x.data<float>(), ones.data<float>(),
                             ones.data<float>(), clamp, y.data<float>());
        kernels::scale_shift_reference(Parallel::shared(), {1, kChannels}, x.data<float>(), ones.data<float>(),
                                       ones.data<float>(), clamp, reference.data<float>());
        INFO("clamp " << static_cast<int>(clamp) << ", channel " << at);
        for (Index c = 0; c < kChannels; ++c) {
          CHECK(std::isnan(y.data<float>()[c]) == (c == at));
          CHECK(std::isnan(reference.data<float>()[c]) == (c == at));
        }
      }
  });
}
