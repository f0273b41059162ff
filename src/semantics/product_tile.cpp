#include "semantics/product_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semantics/product_tile.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::semantics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 4 rows by 3 vectors: 12 sums, 3 vectors of the right panel and one element of the left panel take 16 registers. At
// most 8 lanes, so that the right width divides the tile.
using Doubles = hn::CappedTag<double, 8>;
constexpr Index kLeftWidth = 4;

PanelWidths panel_widths_here() { return {kLeftWidth, 3 * static_cast<Index>(hn::Lanes(Doubles()))}; }

void add_products_here(const double* left, const double* right, Index depth, double* products) {
  const Doubles d;
  const Index lanes = hn::Lanes(d), width = 3 * lanes;
  for (Index j = 0; j < kProductTile; j += width)
    for (Index i = 0; i < kProductTile; i += kLeftWidth) {
      const double* HWY_RESTRICT a = left + i * depth;
      const double* HWY_RESTRICT b = right + j * depth;
      double* HWY_RESTRICT c = products + i * kProductTile + j;
      const auto at = [&](Index row, Index vector) HWY_ATTR { return c + row * kProductTile + vector * lanes; };
      auto c00 = hn::Load(d, at(0, 0)), c01 = hn::Load(d, at(0, 1)), c02 = hn::Load(d, at(0, 2));
      auto c10 = hn::Load(d, at(1, 0)), c11 = hn::Load(d, at(1, 1)), c12 = hn::Load(d, at(1, 2));
      auto c20 = hn::Load(d, at(2, 0)), c21 = hn::Load(d, at(2, 1)), c22 = hn::Load(d, at(2, 2));
      auto c30 = hn::Load(d, at(3, 0)), c31 = hn::Load(d, at(3, 1)), c32 = hn::Load(d, at(3, 2));
      for (Index k = 0; k < depth; ++k, a += kLeftWidth, b += width) {
        const auto b0 = hn::Load(d, b), b1 = hn::Load(d, b + lanes), b2 = hn::Load(d, b + 2 * lanes);
        auto x = hn::Set(d, a[0]);
        c00 = hn::MulAdd(x, b0, c00), c01 = hn::MulAdd(x, b1, c01), c02 = hn::MulAdd(x, b2, c02);
        x = hn::Set(d, a[1]);
        c10 = hn::MulAdd(x, b0, c10), c11 = hn::MulAdd(x, b1, c11), c12 = hn::MulAdd(x, b2, c12);
        x = hn::Set(d, a[2]);
        c20 = hn::MulAdd(x, b0, c20), c21 = hn::MulAdd(x, b1, c21), c22 = hn::MulAdd(x, b2, c22);
        x = hn::Set(d, a[3]);
        c30 = hn::MulAdd(x, b0, c30), c31 = hn::MulAdd(x, b1, c31), c32 = hn::MulAdd(x, b2, c32);
      }
      hn::Store(c00, d, at(0, 0)), hn::Store(c01, d, at(0, 1)), hn::Store(c02, d, at(0, 2));
      hn::Store(c10, d, at(1, 0)), hn::Store(c11, d, at(1, 1)), hn::Store(c12, d, at(1, 2));
      hn::Store(c20, d, at(2, 0)), hn::Store(c21, d, at(2, 1)), hn::Store(c22, d, at(2, 2));
      hn::Store(c30, d, at(3, 0)), hn::Store(c31, d, at(3, 1)), hn::Store(c32, d, at(3, 2));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::semantics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::semantics {

HWY_EXPORT(panel_widths_here);
HWY_EXPORT(add_products_here);

PanelWidths panel_widths() { return HWY_DYNAMIC_DISPATCH(panel_widths_here)(); }

void add_products(const double* left, const double* right, Index depth, double* products) {
  HWY_DYNAMIC_DISPATCH(add_products_here)(left, right, depth, products);
}

}  // namespace svnet::semantics
#endif
