#pragma once
#include <algorithm>

#include "nn/kernels/packed/panel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// Weights are kept transformed up to this many pairs of input and output channels.
inline constexpr Index kMostTransformed = 128 * 256;

/// A tile is 4×4 outputs of an image.
struct WinogradTile {
  Index image, row, column;
};

/// Tiles [begin, end) of all.
struct TileRange {
  Index begin, end;
  Index count() const { return end - begin; }
};

/// How winograd_conv2d cuts its work, and the layout of its scratch memory. Depends on the shape alone.
struct WinogradPlan {
  Window window;
  Index k;  ///< output channels
  bool transformed;
  Index tiles_down, tiles_across;
  Index block;  ///< tiles that go through the steps together
  Index run;    ///< input channels whose weights are transformed together

  enum class Use { by_tiles, by_channels, weight_gradient };

  WinogradPlan(const Window& w, Index channels, Use use)
      : window(w),
        k(channels),
        transformed(use == Use::by_tiles),
        tiles_down((w.oh + 3) / 4),
        tiles_across((w.ow + 3) / 4),
        block(even(tiles(), use == Use::by_tiles      ? 28
                            : use == Use::by_channels ? 128
                                                      : 256)),
        run(std::min<Index>(w.c, 128)) {}

  Index tiles() const { return window.n * tiles_down * tiles_across; }
  WinogradTile tile(Index i) const {
    return {i / (tiles_down * tiles_across), i / tiles_across % tiles_down, i % tiles_across};
  }

  // Distances in floats between two points of `count` tiles, and between two panels of channels. Points are an odd
  // number of cache lines apart, so that the 36 points of a tile never share a set of the cache.
  Index input_point(Index count) const { return odd_lines(count); }
  Index input_group(Index count) const { return 36 * input_point(count); }
  Index output_point(Index count) const { return odd_lines(count); }

  Index input_size(Index count) const { return window.c / kPanel * input_group(count); }
  Index output_size(Index count) const { return 36 * output_point(count); }
  Index weight_point() const { return odd_lines(run); }
  Index weight_size() const { return 36 * weight_point(); }
  Index worker_scratch() const {
    return kMostTilePanels * output_size(block) + (transformed ? input_size(block) : kMostTilePanels * weight_size());
  }
  Index scratch(int threads) const { return threads * worker_scratch() + (transformed ? 0 : input_size(block)); }

 private:
  static Index odd_lines(Index count) { return (count | 1) * kPanel; }
  static Index even(Index count, Index most) {
    const Index blocks = std::max<Index>((count + most - 1) / most, 1);
    return (count + blocks - 1) / blocks;
  }
};

}  // namespace svnet::kernels
