// Tiles of an image to points: the first step of the forward and of the weight gradient.
#if defined(SVNET_WINOGRAD_TILES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_WINOGRAD_TILES_INL_H_
#undef SVNET_WINOGRAD_TILES_INL_H_
#else
#define SVNET_WINOGRAD_TILES_INL_H_
#endif

#include <cstring>

#include "nn/kernels/winograd/plan.h"
#include "nn/kernels/winograd/transforms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

inline constexpr Index kLanes = kPanel / kVectorsPerPanel;

/// The points of tiles [begin, end) among those of the group [first, last): [c / 16][36][last - first][16].
HWY_INLINE void transform_inputs(const WinogradPlan& plan, const float* x, Index first, Index last, Index begin,
                                 Index end, float* points) {
  const Window& w = plan.window;
  const Index groups = w.c / kPanel, image = w.w * w.c;
  alignas(kAlignment) float border[36 * kPanel];
  for (Index tile = begin; tile < end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index row = 4 * t.row - w.top, column = 4 * t.column - w.left;
    const float* from = x + ((t.image * w.h + row) * w.w + column) * w.c;
    const bool inside = row >= 0 && column >= 0 && row + 6 <= w.h && column + 6 <= w.w;
    for (Index g = 0; g < groups; ++g) {
      float* to = points + g * plan.input_group(last - first) + (tile - first) * kPanel;
      const float* source = from + g * kPanel;
      Index source_row = image, source_column = w.c;
      if (!inside) {
        for (Index i = 0; i < 6; ++i)
          for (Index j = 0; j < 6; ++j) {
            const bool in_image = row + i >= 0 && row + i < w.h && column + j >= 0 && column + j < w.w;
            float* pixel = border + (i * 6 + j) * kPanel;
            if (in_image)
              std::memcpy(pixel, source + i * image + j * w.c, kPanel * sizeof(float));
            else
              std::memset(pixel, 0, kPanel * sizeof(float));
          }
        source = border;
        source_row = 6 * kPanel;
        source_column = kPanel;
      }
      for (Index v = 0; v < kPanel; v += kLanes)
        transform_input_vector(source + v, source_row, source_column, to + v, plan.input_point(last - first));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
