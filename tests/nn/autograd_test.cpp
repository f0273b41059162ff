#include "nn/autograd.h"

#include <catch2/catch.hpp>
#include <functional>

#include <pthread.h>

#include "nn/numbers.h"
#include "nn/ops/activations.h"
#include "nn/ops/dense.h"
#include "nn/ops/shaping.h"

using namespace svnet;
using namespace svnet::test;
using autograd::backward;
using autograd::GradientMap;
using autograd::Gradients;

namespace {

Tensor row(const std::vector<double>& values) { return Tensor::from(Shape{static_cast<Index>(values.size())}, values); }

/// x times a constant.
Tensor scaled(const Tensor& x, double factor) {
  const auto times = [factor](const Tensor& a) {
    Tensor y = a.clone();
    for (Index i = 0; i < y.size(); ++i) y.data<double>()[i] *= factor;
    return y;
  };
  return autograd::record(times(x), {x}, [times](const Tensor& dy, Gradients& g) { g.add(0, times(dy)); });
}

/// The same elements; the gradient passes unchanged.
Tensor passed(const Tensor& x) {
  return autograd::record(x, {x}, [](const Tensor& dy, Gradients& g) { g.add(0, dy); });
}

/// Runs body on a thread whose stack has 1 MiB, which 100,000 nested calls of any kind overflow.
void on_small_stack(const std::function<void()>& body) {
  pthread_attr_t attributes;
  pthread_t thread;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, 1 << 20) == 0);
  const auto run = [](void* argument) -> void* {
    (*static_cast<const std::function<void()>*>(argument))();
    return nullptr;
  };
  auto copy = body;
  REQUIRE(pthread_create(&thread, &attributes, run, &copy) == 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

}  // namespace

TEST_CASE("a tensor that is used twice receives the sum of its gradients") {
  const Tensor x = row({1, -2}).as_parameter();
  const Tensor a = scaled(x, 3);  // the top of the diamond
  const Tensor y = ops::add({scaled(a, 5), scaled(a, 7), x});
  GradientMap gradients;
  backward(y, gradients, row({1, 10}));
  CHECK(same_bits(gradients.of(x), row({37, 370})));
}

TEST_CASE("a gradient that several inputs share is not changed by adding to one of them") {
  // add passes one dy to both inputs: the sum of a must not change that of b, or the seed.
  const Tensor a = row({1, 2}).as_parameter(), b = row({3, 4}).as_parameter();
  const Tensor inner = ops::add({a, b});
  const Tensor y = ops::add({inner, passed(a), passed(a), b});
  const Tensor seed = row({1, 100});
  GradientMap gradients;
  backward(y, gradients, seed);
  CHECK(same_bits(gradients.of(a), row({3, 300})));
  CHECK(same_bits(gradients.of(b), row({2, 200})));
  CHECK(same_bits(seed, row({1, 100})));

  SECTION("a gradient that the caller holds stays as it is when another tape adds to it") {
    const Tensor held = gradients.of(a);
    backward(ops::add({a, b}), gradients, seed);
    CHECK(same_bits(held, row({3, 300})));
    CHECK(same_bits(gradients.of(a), row({4, 400})));
    gradients.clear();
    CHECK_FALSE(gradients.of(a).defined());
  }
}

TEST_CASE("x + x gives twice the gradient") {
  const Tensor x = row({5}).as_parameter();
  GradientMap gradients;
  backward(ops::add({x, x}), gradients);
  CHECK(same_bits(gradients.of(x), row({2})));
}

TEST_CASE("a tape, and each part of it, can be run once") {
  const Tensor x = row({1}).as_parameter();
  const Tensor shared = scaled(x, 2), y = scaled(shared, 3), z = scaled(shared, 4);
  GradientMap gradients;
  backward(y, gradients);
  CHECK_THROWS_WITH(backward(y, gradients), "[backward] this part of the tape was already run");
  CHECK_THROWS_WITH(backward(z, gradients), "[backward] this part of the tape was already run");
}

TEST_CASE("backward says what it cannot do") {
  const Tensor x = random_tensor({2, 3}, 1).as_parameter();
  GradientMap gradients;
  CHECK_THROWS_WITH(backward(x.detached(), gradients), "[backward] the output does not depend on any parameter");
  CHECK_THROWS_WITH(backward(scaled(x, 2), gradients), "[backward] an output of 2x3 needs a gradient to start from");
  CHECK_THROWS_WITH(backward(scaled(x, 2), gradients, Tensor::zeros({3, 2}, DType::f64)),
                    "[backward] gradient of 3x2 does not fit an output of 2x3");
}

TEST_CASE("gradients arrive in descending order of creation, each node once") {
  struct Recorder : autograd::Sink {
    std::vector<const autograd::Node*> order;
    void add(const autograd::Node& parameter, Tensor) override { order.push_back(&parameter); }
  } sink;
  std::vector<Tensor> parameters;
  Tensor y = row({1});
  for (int i = 0; i < 4; ++i) {
    parameters.push_back(row({1}).as_parameter());
    y = ops::add({y, parameters.back()});
  }
  backward(y, sink);
  REQUIRE(sink.order.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(sink.order[i] == parameters[3 - i].node().get());
}

TEST_CASE("a chain of 100,000 operations is built, run and released without deep recursion") {
  on_small_stack([] {
    Tensor x = row({1}).as_parameter(), y = x;
    for (int i = 0; i < 100000; ++i) y = passed(y);
  });
  double gradient = 0;
  on_small_stack([&] {
    Tensor x = row({1}).as_parameter(), y = x;
    for (int i = 0; i < 100000; ++i) y = passed(y);
    GradientMap gradients;
    backward(y, gradients);
    gradient = gradients.of(x).item();
  });
  CHECK(gradient == 1);
  on_small_stack([&] {  // every node is reached on two paths
    Tensor x = row({1}).as_parameter(), y = x;
    for (int i = 0; i < 100000; ++i)
      y = autograd::record(y, {y, y}, [i](const Tensor& dy, Gradients& g) { g.add(i % 2 == 0 ? 0 : 1, dy); });
    GradientMap gradients;
    backward(y, gradients);
    gradient += gradients.of(x).item();
  });
  CHECK(gradient == 2);
}

TEST_CASE("nothing is recorded if no input wants a gradient") {
  const auto token = std::make_shared<int>(0);
  const Tensor x = random_tensor({2, 3}, 1, DType::f64, 0.1, 1);
  const Tensor y = autograd::record(x.clone(), {x}, [token](const Tensor&, Gradients&) {});
  CHECK(token.use_count() == 1);
  CHECK_FALSE(y.wants_gradient());
  const Tensor z = ops::relu(x);  // its closure would keep z
  CHECK(z.unique());
  const Tensor recorded = ops::relu(x.as_parameter());
  CHECK(recorded.wants_gradient());
  CHECK_FALSE(recorded.unique());
}

TEST_CASE("closures are released while the tape runs, and if a tape is dropped") {
  const auto token = std::make_shared<int>(0);
  Tensor x = row({1}).as_parameter(), y = x;
  std::vector<long> holders;  // of the token, as each closure runs
  for (int i = 0; i < 5; ++i)
    y = autograd::record(y, {y}, [token, &holders](const Tensor& dy, Gradients& g) {
      holders.push_back(token.use_count());
      g.add(0, dy);
    });
  CHECK(token.use_count() == 6);
  SECTION("run") {
    GradientMap gradients;
    backward(y, gradients);
    CHECK(holders == std::vector<long>{6, 5, 4, 3, 2});
    CHECK(token.use_count() == 1);
  }
  SECTION("dropped") {
    y = {};
    CHECK(token.use_count() == 1);
  }
}

TEST_CASE("a dense layer's weight gradient reaches the sink as x and dy") {
  struct Products : autograd::Sink {
    int added = 0;
    std::vector<Tensor> product;
    void add(const autograd::Node&, Tensor) override { ++added; }
    void add_product(const autograd::Node&, const Tensor& x, const Tensor& dy) override { product = {x, dy}; }
  } sink;
  const Tensor x = random_tensor({5, 3}, 1), w = random_tensor({3, 2}, 2).as_parameter(), dy = random_tensor({5, 2}, 3);
  backward(ops::dense(x, w), sink, dy);
  CHECK(sink.added == 0);
  REQUIRE(sink.product.size() == 2);
  CHECK(sink.product[0].data<double>() == x.data<double>());  // the same storage, not a copy
  CHECK(same_bits(sink.product[1], dy));

  SECTION("a sink without an opinion receives the product") {
    GradientMap gradients;
    backward(ops::dense(x, w), gradients, dy);
    Tensor truth = Tensor::zeros({3, 2}, DType::f64);
    for (Index m = 0; m < 5; ++m)
      for (Index i = 0; i < 3; ++i)
        for (Index j = 0; j < 2; ++j)
          truth.data<double>()[i * 2 + j] += x.data<double>()[m * 3 + i] * dy.data<double>()[m * 2 + j];
    CHECK(error_in_epsilons(gradients.of(w), truth, Tensor::full({3, 2}, 5, DType::f64)) <= 1);
  }
  SECTION("a weight that is computed does not: its product is formed for its own closure") {
    sink.product.clear();
    const Tensor flat = random_tensor({6}, 2).as_parameter();
    backward(ops::dense(x, ops::reshape(flat, {3, 2})), sink, dy);
    CHECK(sink.added == 1);
    CHECK(sink.product.empty());
  }
}

TEST_CASE("a map that keeps products forms them on request, or when more gradients arrive") {
  const Tensor x = random_tensor({4, 3}, 1), w = random_tensor({3, 5}, 2).as_parameter();
  const Tensor seed = random_tensor({4, 5}, 3);
  const auto run = [&](GradientMap& gradients, int times) {
    Tensor y = ops::dense(x, w);
    for (int i = 1; i < times; ++i) y = ops::add({y, ops::dense(x, w)});
    autograd::backward(y, gradients, seed);
  };
  for (int times : {1, 2}) {
    GradientMap formed, kept(GradientMap::Products::keep);
    run(formed, times);
    run(kept, times);
    CHECK((kept.product_of(w) != nullptr) == (times == 1));
    CHECK(formed.product_of(w) == nullptr);
    CHECK(same_bits(kept.of(w), formed.of(w)));
  }
}
