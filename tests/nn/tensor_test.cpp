#include "nn/tensor.h"

#include <catch2/catch.hpp>
#include <cstdint>

#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

TEST_CASE("copies of tensors share storage, clones do not") {
  Tensor x = Tensor::from<float>({2, 2}, {1, 2, 3, 4});
  CHECK(x.unique());
  Tensor shared = x, other = x.clone();
  CHECK_FALSE(x.unique());
  shared.data<float>()[0] = 9;
  CHECK(x.data<float>()[0] == 9);
  CHECK(other.data<float>()[0] == 1);
  const Tensor flat = x.reshaped({4});
  CHECK(flat.data<float>() == x.data<float>());
  CHECK(same_bits(other.to(DType::f64).to(DType::f32), other));
}

TEST_CASE("tensors have a shape and are 64-byte aligned") {
  const Tensor x = Tensor::zeros({2, 3, 5}, DType::f64);
  CHECK(x.size() == 30);
  CHECK(x.rank() == 3);
  CHECK(x.dim(0) == 2);
  CHECK(x.dim(-1) == 5);
  CHECK(reinterpret_cast<std::uintptr_t>(x.data<double>()) % 64 == 0);
  CHECK(to_string(x.shape()) == "2x3x5");
  CHECK(to_string({}) == "scalar");
  CHECK(Tensor::full({}, 2.5).item() == 2.5);
  CHECK(Tensor::zeros({0, 4}).size() == 0);
  CHECK_FALSE(Tensor{}.defined());
}

TEST_CASE("tensors say what is wrong") {
  const Tensor x = Tensor::zeros({2, 3});
  CHECK_THROWS_WITH(Tensor::from<float>({2, 3}, {1, 2}), "[tensor] shape 2x3 needs 6 values, got 2");
  CHECK_THROWS_WITH(Tensor::empty({2, -3}), "[tensor] negative size in shape 2x-3");
  CHECK_THROWS_WITH(x.item(), "[tensor] item() needs one element, shape is 2x3");
  CHECK_THROWS_WITH(x.reshaped({4}), "[tensor] cannot reshape 2x3 to 4");
  CHECK_THROWS_WITH(x.data<double>(), "[tensor] f32 tensor used as f64");
  CHECK_THROWS_WITH(Tensor{}.data<float>(), "[tensor] empty tensor used as f32");
}
