#include "nn/optim/optimizer.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nn/numbers.h"
#include "nn/optim/schedule.h"

using namespace svnet;
using namespace svnet::test;

namespace {

constexpr Index kCount = 20003;  // more than one chunk
constexpr int kSteps = 7;
constexpr double kRate = 0.03;

Tensor gradient(int step, DType dtype) {
  return random_tensor({kCount}, 100 + static_cast<std::uint64_t>(step), dtype);
}

void step_once(Optimizer& optimizer, const Tensor& parameter, int step) {
  autograd::GradientMap gradients;
  gradients.add(*parameter.node(), gradient(step, parameter.dtype()));
  optimizer.step(gradients, kRate);
}

/// θ − θ₀ after the steps, with the formula update(g, t) of one number's step in f64.
template <class State>
Tensor by_hand() {
  Tensor moved = Tensor::zeros({kCount}, DType::f64);
  std::vector<State> states(kCount);
  for (int t = 1; t <= kSteps; ++t) {
    const Tensor g = gradient(t, DType::f32).to(DType::f64);
    for (Index i = 0; i < kCount; ++i)
      moved.data<double>()[i] += states[static_cast<std::size_t>(i)].step(g.data<double>()[i], t);
  }
  return moved;
}

struct AdamByHand {
  double m = 0, v = 0;
  double step(double g, int t) {
    m = 0.9 * m + 0.1 * g;
    v = 0.999 * v + 0.001 * g * g;
    return -kRate * std::sqrt(1 - std::pow(0.999, t)) / (1 - std::pow(0.9, t)) * m / (std::sqrt(v) + 1e-7);
  }
};

struct SgdByHand {
  double u = 0;
  double step(double g, int) { return u = 0.8 * u - kRate * g; }
};

/// Runs the optimiser from zeros, so that f32 keeps the full precision of the updates.
template <class Make>
Tensor moved(DType dtype, const Make& make) {
  const Tensor parameter = Tensor::zeros({kCount}, dtype).as_parameter();
  const auto optimizer = make({parameter});
  for (int t = 1; t <= kSteps; ++t) {
    // The f64 run gets the gradients of the f32 run.
    autograd::GradientMap gradients;
    gradients.add(*parameter.node(), gradient(t, DType::f32).to(dtype));
    optimizer->step(gradients, kRate);
  }
  CHECK(optimizer->steps == kSteps);
  return parameter.detached();
}

}  // namespace

TEST_CASE("adam follows its formula") {
  const auto make = [](std::vector<Tensor> p) { return adam(std::move(p)); };
  const Tensor truth = by_hand<AdamByHand>(), magnitude = Tensor::full({kCount}, kSteps * kRate, DType::f64);
  CHECK(error_in_epsilons(moved(DType::f64, make), truth, magnitude) <= 8);
  CHECK(error_in_epsilons(moved(DType::f32, make), truth, magnitude) <= 8);
}

TEST_CASE("sgd with momentum follows its formula") {
  const auto make = [](std::vector<Tensor> p) { return sgd(std::move(p), {.momentum = 0.8}); };
  const Tensor truth = by_hand<SgdByHand>(), magnitude = Tensor::full({kCount}, kSteps * kRate, DType::f64);
  CHECK(error_in_epsilons(moved(DType::f64, make), truth, magnitude) <= 8);
  CHECK(error_in_epsilons(moved(DType::f32, make), truth, magnitude) <= 8);
}

TEST_CASE("parameters without a gradient stay as they are") {
  const Tensor with = random_tensor({kCount}, 1).as_parameter(), without = random_tensor({2, 3}, 2).as_parameter();
  const Tensor before = without.clone();
  for (const auto& optimizer : {adam({with, without}, {.weight_decay = 0.1}), sgd({with, without})})
    step_once(*optimizer, with, 1);
  CHECK(same_bits(without.detached(), before));
}

TEST_CASE("a restored optimiser continues as if it had not stopped") {
  for (const auto& make : {+[](std::vector<Tensor> p) { return adam(std::move(p)); },
                           +[](std::vector<Tensor> p) { return sgd(std::move(p), {.momentum = 0.8}); }}) {
    const Tensor parameter = random_tensor({kCount}, 1, DType::f32).as_parameter();
    const auto first = make({parameter});
    for (int t = 1; t <= 3; ++t) step_once(*first, parameter, t);
    const Tensor resumed = parameter.clone().as_parameter();
    const auto second = make({resumed});
    second->restore(first->state(), first->steps);
    for (int t = 4; t <= 6; ++t) {
      step_once(*first, parameter, t);
      step_once(*second, resumed, t);
    }
    CHECK(same_bits(parameter.detached(), resumed.detached()));

    second->restore({}, 0);  // back to the start
    const Tensor again = resumed.clone().as_parameter();
    const auto fresh = make({again});
    step_once(*second, resumed, 1);
    step_once(*fresh, again, 1);
    CHECK(same_bits(resumed.detached(), again.detached()));
  }
  const auto optimizer = adam({Tensor::zeros({2}).as_parameter()});
  CHECK_THROWS_WITH(optimizer->restore({Tensor::zeros({2})}, 1),
                    "[optimizer] the saved state has 1 tensors, expected 2");
  CHECK_THROWS_WITH(optimizer->restore({Tensor::zeros({2}), Tensor::zeros({3})}, 1),
                    "[optimizer] saved tensor 1 is 3, expected 2");
}

TEST_CASE("learning-rate schedules") {
  const Schedule constant{.base = 0.5};
  CHECK(constant.at(0) == 0.5);
  CHECK(constant.at(1000) == 0.5);
  const Schedule step{.kind = Schedule::Kind::step, .base = 1, .period = 10, .factor = 0.5};
  CHECK(step.at(9) == 1);
  CHECK(step.at(10) == 0.5);
  CHECK(step.at(29) == 0.25);
  const Schedule cosine{.kind = Schedule::Kind::cosine, .base = 2, .total = 8};
  CHECK(cosine.at(0) == Approx(2));
  CHECK(cosine.at(2) == Approx(1 + std::sqrt(0.5)));
  CHECK(cosine.at(4) == Approx(1));
  CHECK(cosine.at(8) == Approx(0).margin(1e-15));
  CHECK(cosine.at(9) == Approx(0).margin(1e-15));
  const Schedule warm{.kind = Schedule::Kind::cosine, .base = 2, .total = 8, .warm_up = 3};
  CHECK(warm.at(0) == Approx(0.5));
  CHECK(warm.at(2) == Approx(1.5));
  CHECK(warm.at(3) == Approx(2));
  CHECK(warm.at(7) == Approx(1));
  CHECK(warm.at(11) == Approx(0).margin(1e-15));
}

TEST_CASE("weight decay shrinks only kernels, before the step and by the learning rate") {
  const Tensor kernel = Tensor::full({2, 3}, 2).as_parameter(), bias = Tensor::full({3}, 2).as_parameter();
  const auto optimizer = adam({kernel, bias}, {.weight_decay = 0.1});
  autograd::GradientMap gradients;  // both receive the same gradient
  gradients.add(*kernel.node(), Tensor::full({2, 3}, 1));
  gradients.add(*bias.node(), Tensor::full({3}, 1));
  optimizer->step(gradients, 0.5);
  CHECK(bias.values<float>()[0] == Approx(1.5));  // Adam's first step is the rate
  CHECK(kernel.values<float>()[0] == Approx(2 * 0.95 - 0.5));
}
