#pragma once
#include "nn/kernels/packed/panel.h"

namespace svnet::kernels {

/// The register tiles of one instruction set and one precision.
struct TileKernels {
  Index rows;                       ///< the most rows of a tile
  Index panels;                     ///< the most panels of a tile, 1 or 2
  const MultiplyTile* one_panel;    ///< [rows]: kernels of 1, …, rows rows and one panel
  const MultiplyTile* most_panels;  ///< [rows]: kernels of 1, …, rows rows and `panels` panels

  const MultiplyTile* of(Index count) const { return count == panels ? most_panels : one_panel; }
};

/// Products in f32, of the instruction set in force.
TileKernels f32_tiles();

/// How a product fetches the panels that it needs next.
enum class Prefetch { none, following_panels };

/// c (rows, panels · 16) = finish(a (rows, depth) · panels [+ c]) for any number of rows, which are cut into tiles of
/// nearly equal height. `panels` is 1 or kernels.panels; panels are panel_stride apart. Prefetch::following_panels: the
/// next panels lie directly after these, again panel_stride apart.
void multiply_panels(const TileKernels& kernels, Index panels, Index rows, PanelRows a, Index depth, const float* panel,
                     Index panel_stride, TileOutput out, Prefetch prefetch = Prefetch::none);

}  // namespace svnet::kernels
