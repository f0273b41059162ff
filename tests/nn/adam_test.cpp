#include "nn/kernels/adam/adam.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/instruction_sets.h"
#include "nn/kernels/adam/adam_product.h"
#include "nn/kernels/gemm.h"
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

TEST_CASE("adam on a product gives what adam on the formed product gives") {
  const kernels::AdamStep step{.rate = 0.01, .beta1 = 0.9, .beta2 = 0.999, .epsilon = 1e-7};
  for_instruction_sets([&](const std::string& name) {
    for (const kernels::AdamProductShape& s : {kernels::AdamProductShape{5, 50, 33}, {32, 7, 600}, {1, 30, 16}}) {
      INFO(name << ": " << s.m << "x" << s.c << "ᵀ * " << s.m << "x" << s.k);
      const Tensor x = random_tensor({s.m, s.c}, 1, DType::f32), dy = random_tensor({s.m, s.k}, 5, DType::f32);
      Tensor p = random_tensor({s.c, s.k}, 2, DType::f32), m = random_tensor({s.c, s.k}, 3, DType::f32),
             v = random_tensor({s.c, s.k}, 4, DType::f32, 0, 1);
      Tensor expected = p.to(DType::f64), m2 = m.to(DType::f64), v2 = v.to(DType::f64);
      Tensor gradient = Tensor::empty({s.c, s.k}, DType::f64);
      kernels::gemm_reference<double>({.m = s.c, .n = s.k, .k = s.m, .transpose_a = true},
                                      x.to(DType::f64).data<double>(), dy.to(DType::f64).data<double>(),
                                      gradient.data<double>());
      std::vector<Tensor> seen;
      for (int threads : {1, 3}) {
        Parallel parallel(threads);
        Tensor p1 = p.clone(), m1 = m.clone(), v1 = v.clone();
        kernels::adam_product(parallel, step, s, x.data<float>(), dy.data<float>(), p1.data<float>(), m1.data<float>(),
                              v1.data<float>());
        seen.push_back(p1);
        if (threads == 1) {
          kernels::adam_reference(parallel, step, gradient.size(), gradient.data<double>(), expected.data<double>(),
                                  m2.data<double>(), v2.data<double>());
          double worst = 0;
          for (Index i = 0; i < gradient.size(); ++i) {
            worst = std::max(worst, std::abs(p1.data<float>()[i] - expected.data<double>()[i]));
            worst = std::max(worst, std::abs(m1.data<float>()[i] - m2.data<double>()[i]));
            worst = std::max(worst, std::abs(v1.data<float>()[i] - v2.data<double>()[i]));
          }
          CHECK(worst <= 1e-6);
        }
      }
      CHECK(same_bits(seen[0], seen[1]));
    }
  });
}
