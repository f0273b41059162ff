#pragma once
#include <span>
#include <vector>

#include "base/aligned.h"
#include "nn/kernels/packed/panel.h"

namespace svnet::kernels {

/// What a channel of the left operand of a product has been over pictures: its range and its mean.
struct ChannelRanges {
  std::vector<float> low{}, high{}, mean{};

  bool operator==(const ChannelRanges&) const = default;
};

/// How the left operand (rows, depth) of a product becomes bytes: byte = round(x · factor + zero), limited to [0, 255];
/// halves round to even. NaN becomes 0. `zero` holds whole numbers, which 0 becomes exactly. Arrays are filled up with
/// zeros to whole panels and one more, because a vector may begin at any channel.
struct ByteInput {
  AlignedFloats factor{}, zero{};
};

/// Bytes for channels within ranges, which are widened to include 0. Channel i of `depth` has range i % channels. A
/// channel that is 0 throughout has factor 0.
ByteInput byte_input(Index depth, const ChannelRanges& ranges);

/// to (rows, `stride`) = the rows of a (rows, depth) as quads (int8_tile.h). What fills up the last quad is arbitrary.
/// Requires stride >= packed_row_stride(quads(depth)), and that a may be read one vector past its end.
void round_to_quads(Index rows, const PanelRows& a, Index depth, const ByteInput& input, float* to, Index stride);

}  // namespace svnet::kernels
