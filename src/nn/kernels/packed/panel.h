#pragma once
#include <cstdint>

#include "base/index.h"

namespace svnet::kernels {

/// Columns of a panel. Weights (depth, n) are laid out [n / 16][depth][16] on every instruction set, the last panel
/// filled up with zeros. One row of a panel is one cache line.
inline constexpr Index kPanel = 16;

inline constexpr Index panels(Index n) { return (n + kPanel - 1) / kPanel; }

/// Upper bounds of the rows and panels of a register tile. The instruction set decides how many it has. Under sanitizers,
/// whose compilers need minutes for fourteen rows that are unrolled, tiles are lower.
#ifdef SVNET_SANITIZED
inline constexpr int kMostTileRows = 3, kMostTilePanels = 2;
#else
inline constexpr int kMostTileRows = 14, kMostTilePanels = 2;
#endif

/// The left operand (rows, depth) of a product with a panel. Element (row, i) is
/// data[i / run · block_stride + row · row_stride + i % run]. In plain rows block_stride equals run.
struct PanelRows {
  const float* data;
  Index row_stride, block_stride;
  Index run = kPanel;
};

/// What is done to the sums of a tile before they are stored: y = clamp(sum + bias + residual, low, high). NaN stays
/// NaN.
struct TileFinish {
  const float* bias;      // of the tile's columns
  const float* residual;  // (rows, columns), or nullptr
  Index residual_stride;
  float low, high;
  // Products of bytes only (int8_tile.h), of the tile's columns: the sum is (start + sum of the products) · scale.
  const std::int32_t* start = nullptr;
  const float* scale = nullptr;
};

/// Where a tile is stored. If finish has a residual, panel_stride must be 16.
struct TileOutput {
  float* c;
  Index stride;             // between rows
  bool accumulate = false;  // adds the product to c
  const TileFinish* finish = nullptr;
  Index panel_stride = kPanel;               // between the panels of a row
  Index columns = kMostTilePanels * kPanel;  // columns of c; a wider tile writes only these
  /// Prefetch distance in floats: the tile at panel + prefetch_distance is fetched into L2 during this product. 0:
  /// none.
  Index prefetch_distance = 0;
};

/// One tile: c = finish(a (rows, depth) · panels [+ c]). Each kernel has its own number of rows and panels; panels are
/// panel_stride apart.
using MultiplyTile = void (*)(const PanelRows& a, Index depth, const float* panel, Index panel_stride,
                              const TileOutput& out);

}  // namespace svnet::kernels
