#pragma once
#include "base/index.h"

namespace svnet::kernels {

/// Columns of a panel. Weights (k, n) are laid out [n / 16][k][16], the last panel filled up with zeros, on every
/// instruction set: one row of a panel is one cache line.
inline constexpr Index kPanel = 16;

inline constexpr Index panels(Index n) { return (n + kPanel - 1) / kPanel; }

/// Rows and panels that one tile of registers may span; how many it does depends on the instruction set.
inline constexpr int kMostTileRows = 14, kMostTilePanels = 2;

/// The left operand of a product with a panel: number (row, k) lies at
/// data[k / run · block_stride + row · row_stride + k % run]. Plain rows have block_stride = run.
struct PanelRows {
  const float* data;
  Index row_stride, block_stride;
  Index run = kPanel;
};

/// What is done to the sums of a tile before they are stored: y = clamp(y + bias + residual, low, high); NaN stays NaN.
struct TileFinish {
  const float* bias;      // of the tile's columns
  const float* residual;  // (rows, columns), or nullptr
  Index residual_stride;
  float low, high;
};

/// Where a tile goes: its rows are `stride` apart, its panels of 16 columns `panel_stride`, which is 16 where there is
/// a finish with a residual. With accumulate, what is there is added to.
struct TileOutput {
  float* c;
  Index stride;
  bool accumulate = false;
  const TileFinish* finish = nullptr;
  Index panel_stride = kPanel;
  Index columns = kMostTilePanels * kPanel;  // where the tile has more, what lies behind these stays as it is
  Index ahead = 0;  // how far behind the panel, in numbers, lies another that is fetched into L2 meanwhile
};

/// One tile: c = finish(a (rows, k) · panels [+ c]); rows and panels are the kernel's own, panels `panel_stride` apart.
using MultiplyTile = void (*)(const PanelRows& a, Index k, const float* panel, Index panel_stride,
                              const TileOutput& out);

}  // namespace svnet::kernels
