#pragma once
#include "base/index.h"

namespace svnet::semantics {

constexpr Index kProductTile = 192;   ///< rows and columns of a tile
constexpr Index kProductDepth = 256;  ///< largest depth of one call

/// The widths of the panels for the instruction set in use; both divide kProductTile.
struct PanelWidths {
  Index left, right;
};
PanelWidths panel_widths();

/// products (kProductTile, kProductTile) += left · rightᵀ. left and right are (kProductTile, depth), packed in panels
/// of `width` rows (panel_widths): element d of row r of panel p is at (p · depth + d) · width + r. Requires: 64-byte
/// alignment. Each product is summed in the order of d.
void add_products(const double* left, const double* right, Index depth, double* products);

}  // namespace svnet::semantics
