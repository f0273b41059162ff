#include "nn/kernels/adam/adam.h"

#include <catch2/catch.hpp>

#include "nn/instruction_sets.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

TEST_CASE("adam gives the bits of its reference at every tail, on every instruction set") {
  const kernels::AdamStep step{.rate = 0.01, .beta1 = 0.9, .beta2 = 0.999, .epsilon = 1e-7};
  for_instruction_sets([&](const std::string& name) {
    INFO(name);
    for (Index count = 0; count <= 70; ++count) {
      const Tensor g = random_tensor({count}, 1, DType::f32);
      Tensor p = random_tensor({count}, 2, DType::f32), m = random_tensor({count}, 3, DType::f32),
             v = random_tensor({count}, 4, DType::f32, 0, 1);
      Tensor p2 = p.clone(), m2 = m.clone(), v2 = v.clone();
      Parallel& parallel = Parallel::shared();
      kernels::adam(parallel, step, count, g.data<float>(), p.data<float>(), m.data<float>(), v.data<float>());
      kernels::adam_reference(parallel, step, count, g.data<float>(), p2.data<float>(), m2.data<float>(),
                              v2.data<float>());
      INFO(count << " numbers");
      CHECK(same_bits(p, p2));
      CHECK(same_bits(m, m2));
      CHECK(same_bits(v, v2));
    }
  });
}
