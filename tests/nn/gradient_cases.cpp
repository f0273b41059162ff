#include "nn/gradient_cases.h"

#include <cmath>

#include "nn/numbers.h"
#include "nn/ops/activations.h"
#include "nn/ops/batch_norm.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/dropout.h"
#include "nn/ops/losses.h"
#include "nn/ops/multiply.h"
#include "nn/ops/pooling.h"
#include "nn/ops/shaping.h"

namespace svnet::test {
namespace {

using Inputs = std::vector<Tensor>;
using Cases = std::vector<GradientCase>;

const Shape kImages{2, 7, 5, 3};

struct NamedWindow {
  std::string what;
  WindowOptions options;
};

/// Kernels × strides × paddings.
std::vector<NamedWindow> windows(const std::vector<std::pair<Index, Index>>& kernels) {
  const std::vector<std::pair<Index, Index>> strides{{1, 1}, {2, 2}, {2, 3}};
  const std::vector<std::pair<std::string, Padding>> paddings{
      {"valid", Padding::valid()}, {"same", Padding::same()}, {"1, 0, 2, 1", Padding::of(1, 0, 2, 1)}};
  std::vector<NamedWindow> all;
  for (auto [kh, kw] : kernels)
    for (auto [sh, sw] : strides)
      for (const auto& [what, padding] : paddings)
        all.push_back({joined(kh, "x", kw, " kernel, stride ", sh, "x", sw, ", padding ", what),
                       {.kh = kh, .kw = kw, .stride_h = sh, .stride_w = sw, .padding = padding}});
  return all;
}

ops::ConvOptions conv(const WindowOptions& o) {
  return {.stride_h = o.stride_h, .stride_w = o.stride_w, .padding = o.padding};
}

void add_convolutions(Cases& cases) {
  const auto all = windows({{1, 1}, {3, 3}, {2, 4}, {5, 3}});
  for (const auto& [what, o] : all)
    cases.push_back(
        {"conv2d", what, {random_tensor(kImages, 1), random_tensor({o.kh, o.kw, 3, 4}, 2)}, [o = o](const Inputs& in) {
           return ops::conv2d(in[0], in[1], conv(o));
         }});
  for (Index multiplier : {1, 2, 3})
    for (const auto& [what, o] : all)
      cases.push_back({"depthwise_conv2d",
                       joined(what, ", multiplier ", multiplier),
                       {random_tensor(kImages, 3), random_tensor({o.kh, o.kw, 3, multiplier}, 4)},
                       [o = o](const Inputs& in) { return ops::depthwise_conv2d(in[0], in[1], conv(o)); }});
  for (Index multiplier : {1, 2})
    for (const auto& [what, o] : windows({{3, 3}}))
      cases.push_back({"separable_conv2d",
                       joined(what, ", multiplier ", multiplier),
                       {random_tensor(kImages, 5), random_tensor({3, 3, 3, multiplier}, 6),
                        random_tensor({1, 1, 3 * multiplier, 5}, 7)},
                       [o = o](const Inputs& in) { return ops::separable_conv2d(in[0], in[1], in[2], conv(o)); }});
}

void add_pooling(Cases& cases) {
  const auto all = windows({{2, 2}, {3, 3}, {2, 4}});
  for (const auto& [what, o] : all)
    cases.push_back({"max_pool2d", what, {spaced_tensor(kImages, 8)}, [o = o](const Inputs& in) {
                       return ops::max_pool2d(in[0], o);
                     }});
  cases.push_back({"max_pool2d", "windows wholly in the border", {spaced_tensor(kImages, 8)}, [](const Inputs& in) {
                     return ops::max_pool2d(in[0], {.kh = 2, .kw = 2, .padding = Padding::of(3, 2, 2, 3)});
                   }});
  for (const auto& [what, o] : all)
    cases.push_back({"average_pool2d", what, {random_tensor(kImages, 9)}, [o = o](const Inputs& in) {
                       return ops::average_pool2d(in[0], o);
                     }});
  cases.push_back({"average_pool2d", "windows wholly in the border", {random_tensor(kImages, 9)}, [](const Inputs& in) {
                     return ops::average_pool2d(in[0], {.kh = 2, .kw = 2, .padding = Padding::of(3, 2, 2, 3)});
                   }});
  cases.push_back({"global_max_pool2d", "", {spaced_tensor(kImages, 10)}, [](const Inputs& in) {
                     return ops::global_max_pool2d(in[0]);
                   }});
  cases.push_back({"global_average_pool2d", "", {random_tensor(kImages, 11)}, [](const Inputs& in) {
                     return ops::global_average_pool2d(in[0]);
                   }});
}

void add_dense(Cases& cases) {
  for (Shape s : {Shape{5, 7, 3}, Shape{1, 7, 1}, Shape{9, 1, 4}})
    cases.push_back({"dense",
                     to_string(s),
                     {random_tensor({s[0], s[1]}, 12), random_tensor({s[1], s[2]}, 13)},
                     [](const Inputs& in) { return ops::dense(in[0], in[1]); }});
  cases.push_back({"dense",
                   "weight that is itself computed",
                   {random_tensor({5, 7}, 12), random_tensor({21}, 13)},
                   [](const Inputs& in) {
                     return ops::dense(in[0], ops::reshape(in[1], {7, 3}));
                   }});
  for (const Shape& s : {kImages, Shape{5, 3}})
    cases.push_back({"bias_add", to_string(s), {random_tensor(s, 14), random_tensor({3}, 15)}, [](const Inputs& in) {
                       return ops::bias_add(in[0], in[1]);
                     }});
}

/// Elements from −5 to 5, at least 0.01 away from −3 and 3.
Tensor away_from_kinks_at_3(const Shape& shape) {
  Tensor x = random_tensor(shape, 46, DType::f64, -5, 5);
  for (Index i = 0; i < x.size(); ++i) {
    double& value = x.data<double>()[i];
    if (std::abs(std::abs(value) - 3) < 0.01) value += 0.05;
  }
  return x;
}

void add_activations(Cases& cases) {
  cases.push_back({"relu", "", {spaced_tensor(kImages, 16)}, [](const Inputs& in) { return ops::relu(in[0]); }});
  // Shifted by 3, the elements cover both kinks and stay 0.01 away from them.
  Tensor around_both = spaced_tensor({451}, 17);
  for (Index i = 0; i < around_both.size(); ++i) around_both.data<double>()[i] += 3.0;
  cases.push_back({"relu6", "", {around_both}, [](const Inputs& in) { return ops::relu6(in[0]); }});
  cases.push_back({"sigmoid", "", {random_tensor(kImages, 18, DType::f64, -4, 4)}, [](const Inputs& in) {
                     return ops::sigmoid(in[0]);
                   }});
  for (const Activation hard : {Activation::hard_sigmoid, Activation::hard_swish})
    cases.push_back({name_of(hard), "", {away_from_kinks_at_3(kImages)}, [hard](const Inputs& in) {
                       return ops::activation(in[0], hard);
                     }});
  for (const Shape& s : {Shape{5, 7}, Shape{2, 3, 4}})
    cases.push_back({"softmax", to_string(s), {random_tensor(s, 19, DType::f64, -2, 2)}, [](const Inputs& in) {
                       return ops::softmax(in[0]);
                     }});
}

void add_multiply(Cases& cases) {
  for (const Shape& factor : {kImages, Shape{2, 1, 1, 3}, Shape{2, 3}})
    cases.push_back(
        {"multiply", to_string(factor), {random_tensor(kImages, 47), random_tensor(factor, 48)}, [](const Inputs& in) {
           return ops::multiply(in[0], in[1]);
         }});
  cases.push_back(
      {"multiply", "the factor first", {random_tensor({2, 3}, 48), random_tensor(kImages, 47)}, [](const Inputs& in) {
         return ops::multiply(in[0], in[1]);
       }});
}

void add_batch_norm(Cases& cases) {
  for (const Shape& s : {Shape{9, 4}, Shape{2, 4}, Shape{3, 5, 7, 4}}) {
    const Inputs inputs{random_tensor(s, 20, DType::f64, -1, 3), random_tensor({4}, 21, DType::f64, 0.5, 2),
                        random_tensor({4}, 22)};
    for (auto convention : {MomentumConvention::keras, MomentumConvention::pytorch})
      cases.push_back({"batch_norm_training", to_string(s), inputs, [convention](const Inputs& in) {
                         const DType dtype = in[0].dtype();
                         Tensor mean = Tensor::zeros({4}, dtype), variance = Tensor::full({4}, 1, dtype);
                         return ops::batch_norm_training(in[0], in[1], in[2], mean, variance,
                                                         {.convention = convention});
                       }});
  }
  for (const Shape& s : {Shape{9, 4}, Shape{1, 4}, Shape{3, 5, 7, 4}}) {
    const Inputs inputs{random_tensor(s, 20, DType::f64, -1, 3), random_tensor({4}, 21, DType::f64, 0.5, 2),
                        random_tensor({4}, 22)};
    cases.push_back({"batch_norm_inference", to_string(s), inputs, [](const Inputs& in) {
                       return ops::batch_norm_inference(in[0], in[1], in[2], random_tensor({4}, 23, in[0].dtype()),
                                                        random_tensor({4}, 24, in[0].dtype(), 0.1, 2), 1e-3);
                     }});
  }
}

void add_shaping(Cases& cases) {
  for (double rate : {0.0, 0.25, 0.75})
    cases.push_back({"dropout", joined("rate ", rate), {random_tensor(kImages, 25)}, [rate](const Inputs& in) {
                       return ops::dropout(in[0], rate, {.seed = 5, .index = 9});
                     }});
  cases.push_back({"reshape", "", {random_tensor(kImages, 26)}, [](const Inputs& in) {
                     return ops::reshape(in[0], {3, 70});
                   }});
  cases.push_back({"flatten", "", {random_tensor(kImages, 27)}, [](const Inputs& in) { return ops::flatten(in[0]); }});
  for (const Padding& p : {Padding::of(1, 0, 2, 3), Padding::of(0, 2, 0, 0)})
    cases.push_back({"zero_padding2d", "", {random_tensor(kImages, 28)}, [p](const Inputs& in) {
                       return ops::zero_padding2d(in[0], p);
                     }});
  cases.push_back({"add",
                   "three",
                   {random_tensor({4, 5}, 29), random_tensor({4, 5}, 30), random_tensor({4, 5}, 31)},
                   [](const Inputs& in) { return ops::add(in); }});
  cases.push_back(
      {"add", "one of them twice", {random_tensor({4, 5}, 29), random_tensor({4, 5}, 30)}, [](const Inputs& in) {
         return ops::add({in[0], in[1], in[0]});
       }});
  cases.push_back({"concat",
                   "features",
                   {random_tensor({4, 5}, 32), random_tensor({4, 1}, 33), random_tensor({4, 2}, 34)},
                   [](const Inputs& in) { return ops::concat(in); }});
  cases.push_back(
      {"concat", "images", {random_tensor(kImages, 35), random_tensor({2, 7, 5, 2}, 36)}, [](const Inputs& in) {
         return ops::concat(in);
       }});
}

void add_losses(Cases& cases) {
  for (const Shape& s : {Shape{7, 1}, Shape{3, 5}})
    cases.push_back({"mean_squared_error", to_string(s), {random_tensor(s, 37)}, [s](const Inputs& in) {
                       return ops::mean_squared_error(in[0], random_tensor(s, 38, in[0].dtype()));
                     }});
  cases.push_back({"softmax_cross_entropy", "", {random_tensor({4, 5}, 39, DType::f64, -3, 3)}, [](const Inputs& in) {
                     return ops::softmax_cross_entropy(in[0], {0, 4, 2, 2});
                   }});
}

void add_network(Cases& cases) {
  cases.push_back(
      {"small network",
       "",
       {random_tensor({2, 6, 5, 2}, 40), random_tensor({3, 3, 2, 4}, 41), random_tensor({4}, 42, DType::f64, 0.5, 1.5),
        random_tensor({4}, 43), random_tensor({4, 3}, 44), random_tensor({3}, 45)},
       [](const Inputs& in) {
         const DType dtype = in[0].dtype();
         Tensor mean = Tensor::zeros({4}, dtype), variance = Tensor::full({4}, 1, dtype);
         const Tensor x = ops::conv2d(in[0], in[1], {.padding = Padding::same()});
         const Tensor y = ops::sigmoid(ops::batch_norm_training(x, in[2], in[3], mean, variance, {}));
         const Tensor z = ops::global_average_pool2d(ops::add({x, y}));
         return ops::softmax_cross_entropy(ops::bias_add(ops::dense(z, in[4]), in[5]), {2, 0});
       }});
}

}  // namespace

std::vector<GradientCase> gradient_cases() {
  Cases cases;
  for (const auto add : {add_convolutions, add_pooling, add_dense, add_activations, add_multiply, add_batch_norm,
                         add_shaping, add_losses, add_network})
    add(cases);
  return cases;
}

}  // namespace svnet::test
