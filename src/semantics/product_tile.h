#pragma once
#include "base/index.h"

namespace svnet {

constexpr Index kProductTile = 192;   ///< rows and columns of a tile of products
constexpr Index kProductDepth = 256;  ///< features multiplied at once

/// The widths of the panels that the instruction set at hand multiplies; both divide kProductTile.
struct PanelWidths {
  Index left, right;
};
PanelWidths panel_widths();

/// products (tile, tile) += left · rightᵀ, where left and right hold kProductTile rows of `depth` numbers each, in
/// panels of as many rows as panel_widths says: row r, number d of panel p at (p · depth + d) · width + r. 64-byte
/// aligned. Each product is a sum in the order of d.
void add_products(const double* left, const double* right, Index depth, double* products);

}  // namespace svnet
