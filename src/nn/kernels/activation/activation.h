// Activations: everything about one stands in this file. Layers, training, compiled inference and model files read it
// from here.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/enum_names.h"
#include "base/index.h"
#include "nn/kernels/epilogue.h"

namespace svnet {

enum class Activation { none, relu, relu6, sigmoid, hard_sigmoid, hard_swish, softmax };

constexpr auto enum_table(Activation) {
  return std::to_array<EnumName<Activation>>({{Activation::none, "linear"},
                                              {Activation::relu, "relu"},
                                              {Activation::relu6, "relu6"},
                                              {Activation::sigmoid, "sigmoid"},
                                              {Activation::hard_sigmoid, "hard_sigmoid"},
                                              {Activation::hard_swish, "hard_swish"},
                                              {Activation::softmax, "softmax"}});
}

namespace kernels {

// An elementwise activation is a struct with
//   value(x)           its formula. NaN stays NaN, so comparisons stand where std::min and std::max would lose it.
//   slope_at_output(y) its derivative as a function of y = value(x), if there is such a function: then training keeps y
//   slope_at_input(x)  its derivative otherwise: then training keeps x
//   kClamp             if a kernel's epilogue can apply it: which clamp it is

struct Linear {
  static constexpr Clamp kClamp = Clamp::none;
  template <class T>
  static T value(T x) {
    return x;
  }
  template <class T>
  static T slope_at_output(T) {
    return T{1};
  }
};

/// max(x, 0). The slope at 0 is 0.
struct Relu {
  static constexpr Clamp kClamp = Clamp::relu;
  template <class T>
  static T value(T x) {
    return x < T{0} ? T{0} : x;
  }
  template <class T>
  static T slope_at_output(T y) {
    return y > T{0} ? T{1} : T{0};
  }
};

/// min(max(x, 0), 6). The slope at 0 and at 6 is 0.
struct Relu6 {
  static constexpr Clamp kClamp = Clamp::relu6;
  template <class T>
  static T value(T x) {
    return range_of<T>(kClamp).clamped(x);
  }
  template <class T>
  static T slope_at_output(T y) {
    constexpr auto kRange = range_of<T>(kClamp);
    return y > kRange.low && y < kRange.high ? T{1} : T{0};
  }
};

/// 1 / (1 + exp(−x)). Never overflows.
struct Sigmoid {
  template <class T>
  static T value(T x) {
    const T e = std::exp(-std::abs(x));
    return x >= T{0} ? T{1} / (T{1} + e) : e / (T{1} + e);
  }
  template <class T>
  static T slope_at_output(T y) {
    return y * (T{1} - y);
  }
};

/// relu6(x + 3) / 6, as in MobileNetV3 (Howard et al., 2019) and Keras 3; Keras 2 has another function of this name.
/// The slope at −3 and at 3 is 0.
struct HardSigmoid {
  template <class T>
  static T value(T x) {
    return Relu6::value(x + T{3}) / T{6};
  }
  template <class T>
  static T slope_at_output(T y) {
    return y > T{0} && y < T{1} ? T{1} / T{6} : T{0};
  }
};

/// x · relu6(x + 3) / 6, as in MobileNetV3 (Howard et al., 2019). The slope at −3 is 0, at 3 it is 1.
struct HardSwish {
  template <class T>
  static T value(T x) {
    return x * HardSigmoid::value(x);
  }
  template <class T>
  static T slope_at_input(T x) {
    return x <= T{-3} ? T{0} : x >= T{3} ? T{1} : (T{2} * x + T{3}) / T{6};
  }
};

/// exp(x) / Σ exp(x) over a row. Shifted by the largest element, so that it never overflows.
struct Softmax {
  /// x and y have `classes` elements; y may be x.
  template <class T>
  static void row(Index classes, const T* x, T* y) {
    const T largest = *std::max_element(x, x + classes);
    T sum{0};
    for (Index c = 0; c < classes; ++c) sum += y[c] = std::exp(x[c] - largest);
    for (Index c = 0; c < classes; ++c) y[c] /= sum;
  }
};

/// Calls body(Relu{}), body(Softmax{}), …: the struct of the activation.
template <class Body>
decltype(auto) with_activation(Activation activation, Body&& body) {
  switch (activation) {
    case Activation::none:
      return body(Linear{});
    case Activation::relu:
      return body(Relu{});
    case Activation::relu6:
      return body(Relu6{});
    case Activation::sigmoid:
      return body(Sigmoid{});
    case Activation::hard_sigmoid:
      return body(HardSigmoid{});
    case Activation::hard_swish:
      return body(HardSwish{});
    case Activation::softmax:
      return body(Softmax{});
  }
  std::abort();
}

/// The clamp that an activation is, if it is one.
inline std::optional<Clamp> clamp_of(Activation activation) {
  return with_activation(activation, []<class A>(A) -> std::optional<Clamp> {
    if constexpr (requires { A::kClamp; })
      return A::kClamp;
    else
      return {};
  });
}

}  // namespace kernels
}  // namespace svnet
