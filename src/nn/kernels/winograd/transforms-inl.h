// The transforms of F(4×4, 3×3) and of its gradients for a vector of channels at a time, with the interpolation points
// 0, ±1, ±2, ∞.
#if defined(SVNET_WINOGRAD_TRANSFORMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_WINOGRAD_TRANSFORMS_INL_H_
#undef SVNET_WINOGRAD_TRANSFORMS_INL_H_
#else
#define SVNET_WINOGRAD_TRANSFORMS_INL_H_
#endif

#include "nn/kernels/packed/panel_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

using V = PanelVector;

struct Six {
  V v0, v1, v2, v3, v4, v5;
};
struct Four {
  V v0, v1, v2, v3;
};

/// Bᵀ d: six inputs of a row or column.
HWY_INLINE Six input_row(V d0, V d1, V d2, V d3, V d4, V d5) {
  const PanelTag d;
  const auto two = hn::Set(d, 2.0f), four = hn::Set(d, 4.0f), five = hn::Set(d, 5.0f);
  const V even = hn::NegMulAdd(four, d2, d4), odd = hn::NegMulAdd(four, d1, d3);
  const V near_even = hn::Sub(d4, d2), near_odd = hn::Mul(two, hn::Sub(d3, d1));
  return {hn::MulAdd(four, d0, hn::NegMulAdd(five, d2, d4)),
          hn::Add(even, odd),
          hn::Sub(even, odd),
          hn::Add(near_even, near_odd),
          hn::Sub(near_even, near_odd),
          hn::MulAdd(four, d1, hn::NegMulAdd(five, d3, d5))};
}

/// G g: three taps.
HWY_INLINE Six weight_row(V g0, V g1, V g2) {
  const PanelTag d;
  const auto sixth = hn::Set(d, -1.0f / 6), quarter = hn::Set(d, 0.25f);
  const auto twelfth = hn::Set(d, 1.0f / 12), twenty_fourth = hn::Set(d, 1.0f / 24);
  const V outer = hn::Mul(sixth, hn::Add(g0, g2)), inner = hn::Mul(sixth, g1);
  const V far = hn::MulAdd(twenty_fourth, g0, hn::Mul(hn::Neg(sixth), g2)), middle = hn::Mul(twelfth, g1);
  return {hn::Mul(quarter, g0), hn::Add(outer, inner), hn::Sub(outer, inner),
          hn::Add(far, middle), hn::Sub(far, middle),  g2};
}

/// Aᵀ m: six points to four outputs.
HWY_INLINE Four output_row(V m0, V m1, V m2, V m3, V m4, V m5) {
  const PanelTag d;
  const auto two = hn::Set(d, 2.0f), four = hn::Set(d, 4.0f), eight = hn::Set(d, 8.0f);
  const V near_sum = hn::Add(m1, m2), near_difference = hn::Sub(m1, m2);
  const V far_sum = hn::Add(m3, m4), far_difference = hn::Sub(m3, m4);
  return {hn::Add(hn::Add(m0, near_sum), far_sum), hn::MulAdd(two, far_difference, near_difference),
          hn::MulAdd(four, far_sum, near_sum), hn::Add(hn::MulAdd(eight, far_difference, near_difference), m5)};
}

/// A dy: four output gradients to six points.
HWY_INLINE Six gradient_row(V y0, V y1, V y2, V y3) {
  const PanelTag d;
  const auto two = hn::Set(d, 2.0f), four = hn::Set(d, 4.0f);
  const V even = hn::Add(y0, y2), odd = hn::Add(y1, y3);
  const V far_even = hn::MulAdd(four, y2, y0), far_odd = hn::Mul(two, hn::MulAdd(four, y3, y1));
  return {y0, hn::Add(even, odd), hn::Sub(even, odd), hn::Add(far_even, far_odd), hn::Sub(far_even, far_odd), y3};
}

struct Three {
  V v0, v1, v2;
};

/// Gᵀ u: six points to the gradients of three taps.
HWY_INLINE Three tap_row(V u0, V u1, V u2, V u3, V u4, V u5) {
  const PanelTag d;
  const auto sixth = hn::Set(d, 1.0f / 6), quarter = hn::Set(d, 0.25f);
  const V near_sum = hn::Mul(sixth, hn::Add(u1, u2)), near_difference = hn::Mul(sixth, hn::Sub(u2, u1));
  const V far_sum = hn::Mul(sixth, hn::Add(u3, u4)), far_difference = hn::Mul(sixth, hn::Sub(u3, u4));
  return {hn::MulAdd(quarter, hn::Add(u0, far_sum), hn::Neg(near_sum)),
          hn::MulAdd(hn::Set(d, 0.5f), far_difference, near_difference), hn::Add(hn::Sub(far_sum, near_sum), u5)};
}

/// Column j of 6×6 points, `point` apart in row-major order; `to` at point j.
HWY_INLINE void store_column(const Six& column, float* to, Index point) {
  const PanelTag d;
  hn::Store(column.v0, d, to);
  hn::Store(column.v1, d, to + 6 * point);
  hn::Store(column.v2, d, to + 12 * point);
  hn::Store(column.v3, d, to + 18 * point);
  hn::Store(column.v4, d, to + 24 * point);
  hn::Store(column.v5, d, to + 30 * point);
}

/// One tile's 6×6 inputs (stride `row` between rows, `column` between columns) to 36 points, `point` apart.
HWY_INLINE void transform_input_vector(const float* x, Index row, Index column, float* to, Index point) {
  const PanelTag d;
  Six t[6];
  for (int i = 0; i < 6; ++i) {
    const float* from = x + i * row;
    t[i] = input_row(hn::LoadU(d, from), hn::LoadU(d, from + column), hn::LoadU(d, from + 2 * column),
                     hn::LoadU(d, from + 3 * column), hn::LoadU(d, from + 4 * column), hn::LoadU(d, from + 5 * column));
  }
  const auto down = [&](int j, V Six::*m) HWY_ATTR {
    store_column(input_row(t[0].*m, t[1].*m, t[2].*m, t[3].*m, t[4].*m, t[5].*m), to + j * point, point);
  };
  down(0, &Six::v0), down(1, &Six::v1), down(2, &Six::v2), down(3, &Six::v3), down(4, &Six::v4), down(5, &Six::v5);
}

/// Nine taps, `tap` apart, to 36 points, `point` apart.
HWY_INLINE void transform_weight_vector(const float* w, Index tap, float* to, Index point) {
  const PanelTag d;
  Six t[3];
  for (int i = 0; i < 3; ++i) {
    const float* from = w + 3 * i * tap;
    t[i] = weight_row(hn::LoadU(d, from), hn::LoadU(d, from + tap), hn::LoadU(d, from + 2 * tap));
  }
  const auto down = [&](int j, V Six::*m)
                        HWY_ATTR { store_column(weight_row(t[0].*m, t[1].*m, t[2].*m), to + j * point, point); };
  down(0, &Six::v0), down(1, &Six::v1), down(2, &Six::v2), down(3, &Six::v3), down(4, &Six::v4), down(5, &Six::v5);
}

/// One tile's 4×4 output gradients, [4][4], to 36 points, `point` apart.
HWY_INLINE void transform_gradient_vector(const V (&y)[4][4], float* to, Index point) {
  Six t[4];
  for (int i = 0; i < 4; ++i) t[i] = gradient_row(y[i][0], y[i][1], y[i][2], y[i][3]);
  const auto down = [&](int j, V Six::*m) HWY_ATTR {
    store_column(gradient_row(t[0].*m, t[1].*m, t[2].*m, t[3].*m), to + j * point, point);
  };
  down(0, &Six::v0), down(1, &Six::v1), down(2, &Six::v2), down(3, &Six::v3), down(4, &Six::v4), down(5, &Six::v5);
}

/// 36 points, `point` apart, to the gradients of nine taps, `tap` apart.
HWY_INLINE void transform_tap_vector(const float* u, Index point, float* to, Index tap) {
  const PanelTag d;
  Three t[6];
  for (int i = 0; i < 6; ++i) {
    const float* from = u + 6 * i * point;
    t[i] = tap_row(hn::Load(d, from), hn::Load(d, from + point), hn::Load(d, from + 2 * point),
                   hn::Load(d, from + 3 * point), hn::Load(d, from + 4 * point), hn::Load(d, from + 5 * point));
  }
  const auto down = [&](int j, V Three::*m) HWY_ATTR {
    const Three r = tap_row(t[0].*m, t[1].*m, t[2].*m, t[3].*m, t[4].*m, t[5].*m);
    hn::StoreU(r.v0, d, to + j * tap);
    hn::StoreU(r.v1, d, to + (3 + j) * tap);
    hn::StoreU(r.v2, d, to + (6 + j) * tap);
  };
  down(0, &Three::v0), down(1, &Three::v1), down(2, &Three::v2);
}

/// 36 points, `point` apart, to 4×4 outputs.
HWY_INLINE void transform_output_vector(const float* m, Index point, V (&y)[4][4]) {
  const PanelTag d;
  Four t[6];
  for (int i = 0; i < 6; ++i) {
    const float* from = m + 6 * i * point;
    t[i] = output_row(hn::Load(d, from), hn::Load(d, from + point), hn::Load(d, from + 2 * point),
                      hn::Load(d, from + 3 * point), hn::Load(d, from + 4 * point), hn::Load(d, from + 5 * point));
  }
  const auto down = [&](int j, V Four::*c) HWY_ATTR {
    const Four r = output_row(t[0].*c, t[1].*c, t[2].*c, t[3].*c, t[4].*c, t[5].*c);
    y[0][j] = r.v0, y[1][j] = r.v1, y[2][j] = r.v2, y[3][j] = r.v3;
  };
  down(0, &Four::v0), down(1, &Four::v1), down(2, &Four::v2), down(3, &Four::v3);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
