#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {

void multiply_panels(const TileKernels& kernels, Index panels, Index rows, PanelRows a, Index depth, const float* panel,
                     Index panel_stride, TileOutput out, Prefetch prefetch) {
  TileFinish finish{};
  if (out.finish != nullptr) finish = *out.finish, out.finish = &finish;
  const MultiplyTile* by_rows = kernels.of(panels);
  const Index tiles = (rows + kernels.rows - 1) / kernels.rows;
  for (Index t = 0; t < tiles; ++t) {
    const Index height = (rows + tiles - t - 1) / (tiles - t);
    // The first tiles fetch the following panels, one each: fetched all at once they would come too late.
    out.prefetch_distance = prefetch == Prefetch::following_panels && t < panels ? (panels + t) * panel_stride : 0;
    by_rows[height - 1](a, depth, panel, panel_stride, out);
    a.data += height * a.row_stride;
    out.c += height * out.stride;
    if (finish.residual != nullptr) finish.residual += height * finish.residual_stride;
    rows -= height;
  }
}

}  // namespace svnet::kernels
