#include "predict/pose_layers.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/parallel.h"
#include "nn/graph/stored_precision.h"
#include "nn/kernels/packed/copy_rows.h"

namespace svnet::predict {
namespace {

using namespace kernels;

Index scratch_size(Index rows, const PackedWeights& w, int threads) {
  return packed_gemm_scratch(rows, w.depth, w.precision, threads);
}
Index scratch_size(Index, const PackedInt8&, int threads) { return int8_gemm_scratch(threads); }

void multiply(Parallel& parallel, Index rows, const float* a, const PackedWeights& w, float* c, float* scratch) {
  packed_gemm(parallel, rows, a, w, {}, c, scratch);
}
void multiply(Parallel& parallel, Index rows, const float* a, const PackedInt8& w, float* c, float* scratch) {
  int8_gemm(parallel, rows, a, w, {}, c, scratch);
}

std::variant<PackedWeights, PackedInt8> laid_out(const SplitGraph& split, const InferenceOptions& options) {
  const Index depth = split.kernel.dim(0), n = split.kernel.dim(1);
  const float* const w = split.kernel.data<float>();
  if (options.int8_dense && is_rounded(split.layer + "/kernel", split.kernel.shape()))
    return packed_int8(depth, n, w, nullptr);
  check_available(options.precision);
  return packed_weights(depth, n, w, nullptr, dense_precision(options.precision));
}

float element(const Tensor& vector, Index i) { return vector.defined() ? vector.data<float>()[i] : 0.0f; }

/// Room for packed weights of up to this size. Memory that no picture fills is never touched, so that the system does
/// not provide it.
PackedWeights room(Index depth, Index n) {
  const Index padded = panels(n) * kPanel;
  return {.panels = aligned_floats(depth * padded), .bias = aligned_floats(padded)};
}

Index place(const PackedWeights& w, Index row, Index column) {
  return (column / kPanel * w.panel_rows + row) * kPanel + column % kPanel;
}

/// NaN stays NaN.
float not_negative(float x) { return x < 0 ? 0.0f : x; }

/// A sum of products in 16 parts, which a compiler turns into vectors.
class LaneSums {
 public:
  void add(const float* a, const float* b, Index count) {
    Index i = 0;
    for (; i + kPanel <= count; i += kPanel)
      for (Index j = 0; j < kPanel; ++j) parts_[static_cast<std::size_t>(j)] += a[i + j] * b[i + j];
    for (; i < count; ++i) parts_[0] += a[i] * b[i];
  }
  float total() const { return std::accumulate(parts_.begin(), parts_.end(), 0.0f); }

 private:
  std::array<float, kPanel> parts_{};
};

/// Poses that one task computes.
constexpr Index kPosesAtOnce = 28;

/// The low and high ends of 16 values.
struct PanelRange {
  std::array<float, kPanel> low, high;
};

}  // namespace

PoseLayers::PoseLayers(const SplitGraph& split, models::AngleEncoding angles, const InferenceOptions& options)
    : encoding_(angles),
      units_(split.kernel.dim(0)),
      hidden_(split.kernel.dim(1)),
      outputs_(split.last_kernel.dim(1)),
      angles_(split.angle_kernel.dim(0)),
      angle_kernel_(split.angle_kernel),
      weights_(laid_out(split, options)),
      bias_(split.bias),
      last_kernel_(split.last_kernel),
      last_bias_(split.last_bias) {
  for (Index unit = 0; unit < units_; ++unit)
    ranges_.push_back(models::linear_range(encoding_, angle_kernel_.data<float>() + unit, units_));
}

void PoseLayers::reserve(Picture& picture) const {
  if (picture.constant.defined()) return;
  const Index rows = 1 + angles_;
  picture.units.reserve(static_cast<std::size_t>(units_));
  picture.units_at = Tensor::empty({rows, units_});
  picture.rows = room(units_ + angles_, hidden_);
  picture.columns.reserve(static_cast<std::size_t>(hidden_));
  picture.signs.resize(static_cast<std::size_t>(hidden_));
  picture.largest.resize(static_cast<std::size_t>(units_));
  picture.few = room(units_ + angles_, hidden_ + outputs_);
  picture.summed = Tensor::empty({outputs_, panels(hidden_) * kPanel});
  picture.kept = Tensor::empty({outputs_, hidden_});
  picture.products = Tensor::empty({rows, hidden_});
  picture.constant = Tensor::empty({rows, units_});
}

void PoseLayers::choose_units(const float* c, Picture& picture) const {
  picture.units.clear();
  float* const constant = picture.constant.data<float>();
  std::fill_n(constant, picture.constant.size(), 0.0f);
  const float* const a = angle_kernel_.data<float>();
  for (Index unit = 0; unit < units_; ++unit) {
    const auto [low, high] = ranges_[static_cast<std::size_t>(unit)];
    if (c[unit] + low >= 0) {
      constant[unit] = c[unit];
      for (Index k = 0; k < angles_; ++k) constant[(1 + k) * units_ + unit] = a[k * units_ + unit];
    } else if (!(c[unit] + high <= 0)) {  // NaN too
      picture.units.push_back(unit);
    }
  }
  const Index count = static_cast<Index>(picture.units.size());
  float* const at = picture.units_at.data<float>();
  for (Index i = 0; i < count; ++i) {
    const Index unit = picture.units[static_cast<std::size_t>(i)];
    at[i] = c[unit];
    for (Index k = 0; k < angles_; ++k) at[(1 + k) * count + i] = a[k * units_ + unit];
  }
}

void PoseLayers::make_rows(Picture& picture) const {
  Parallel& parallel = Parallel::shared();
  const float* const products = picture.products.data<float>();
  const Index count = static_cast<Index>(picture.units.size());
  PackedWeights& to = picture.rows;
  to.n = hidden_;
  to.depth = to.panel_rows = count + angles_;
  std::visit(
      [&](const auto& w) {
        const Index rows = 1 + angles_, scratch = scratch_size(rows, w, parallel.threads());
        if (picture.scratch_size < scratch) {
          picture.scratch = aligned_floats(scratch);
          picture.scratch_size = scratch;
        }
        multiply(parallel, rows, picture.constant.data<float>(), w, picture.products.data<float>(),
                 picture.scratch.get());
        copy_rows(parallel, w, picture.units, to);
      },
      weights_);
  for (Index i = 0; i < panels(hidden_) * kPanel; ++i) {
    to.bias.get()[i] = i < hidden_ ? products[i] + element(bias_, i) : 0.0f;
    for (Index k = 0; k < angles_; ++k)
      to.panels.get()[place(to, count + k, i)] = i < hidden_ ? products[(1 + k) * hidden_ + i] : 0.0f;
  }
}

void PoseLayers::choose_columns(Picture& picture) const {
  const PackedWeights& rows = picture.rows;
  const Index count = static_cast<Index>(picture.units.size());
  // The largest values of the units that may change their sign; the least ones are 0.
  std::vector<float>& largest = picture.largest;
  for (Index i = 0; i < count; ++i) {
    const Index unit = picture.units[static_cast<std::size_t>(i)];
    largest[static_cast<std::size_t>(i)] =
        picture.units_at.data<float>()[i] + ranges_[static_cast<std::size_t>(unit)].high;
  }
  Parallel::shared().for_chunks(panels(hidden_), 4, [&](Index first, Index last, int) {
    for (Index p = first; p < last; ++p) {
      PanelRange range{};
      const float* const panel = rows.panel(p);
      for (Index i = 0; i < count; ++i)
        for (Index j = 0; j < kPanel; ++j) {
          const auto lane = static_cast<std::size_t>(j);
          const float x = panel[i * kPanel + j] * largest[static_cast<std::size_t>(i)];
          range.low[lane] += std::min(x, 0.0f);
          range.high[lane] += std::max(x, 0.0f);
        }
      for (Index j = 0; j < std::min(kPanel, hidden_ - p * kPanel); ++j) {
        const Index column = p * kPanel + j;
        const models::AngleRange own = models::linear_range(encoding_, panel + count * kPanel + j, kPanel);
        const float low = rows.bias.get()[column] + own.low + range.low[static_cast<std::size_t>(j)],
                    high = rows.bias.get()[column] + own.high + range.high[static_cast<std::size_t>(j)];
        picture.signs[static_cast<std::size_t>(column)] = low >= 0    ? Sign::never_negative
                                                          : high <= 0 ? Sign::never_positive
                                                                      : Sign::changes;  // NaN too
      }
    }
  });
  picture.columns.clear();
  for (Index column = 0; column < hidden_; ++column)
    if (picture.signs[static_cast<std::size_t>(column)] == Sign::changes) picture.columns.push_back(column);
}

void PoseLayers::make_few(Picture& picture) const {
  const PackedWeights& rows = picture.rows;
  PackedWeights& few = picture.few;
  const Index count = static_cast<Index>(picture.columns.size());
  few.depth = few.panel_rows = rows.depth;
  few.n = count + outputs_;
  // V of the elements that are never negative, else 0, and of those that may change their sign; by columns.
  const Index padded = panels(hidden_) * kPanel;
  float* const summed = picture.summed.data<float>();
  float* const kept = picture.kept.data<float>();
  std::fill_n(summed, outputs_ * padded, 0.0f);
  for (Index output = 0; output < outputs_; ++output) {
    const float* const last = last_kernel_.data<float>() + output;
    for (Index i = 0; i < count; ++i)
      kept[output * count + i] = last[picture.columns[static_cast<std::size_t>(i)] * outputs_];
    for (Index column = 0; column < hidden_; ++column)
      if (picture.signs[static_cast<std::size_t>(column)] == Sign::never_negative)
        summed[output * padded + column] = last[column * outputs_];
  }
  // Writes one row of `few` from one of `rows`: `from` is its first panel, and its panels are `stride` apart.
  const auto reduce = [&](const float* from, Index stride, const auto& to) {
    for (Index i = 0; i < count; ++i) {
      const Index column = picture.columns[static_cast<std::size_t>(i)];
      to(i) = from[column / kPanel * stride + column % kPanel];
    }
    for (Index output = 0; output < outputs_; ++output) {
      LaneSums sums;
      for (Index p = 0; p < panels(hidden_); ++p)
        sums.add(from + p * stride, summed + output * padded + p * kPanel, kPanel);
      to(count + output) = sums.total();
    }
    for (Index i = few.n; i < panels(few.n) * kPanel; ++i) to(i) = 0;
  };
  Parallel::shared().for_chunks(rows.depth, 8, [&](Index first, Index end, int) {
    for (Index row = first; row < end; ++row)
      reduce(rows.panels.get() + row * kPanel, rows.panel_rows * kPanel,
             [&](Index column) -> float& { return few.panels.get()[place(few, row, column)]; });
  });
  reduce(rows.bias.get(), kPanel, [&](Index column) -> float& { return few.bias.get()[column]; });
  for (Index output = 0; output < outputs_; ++output) few.bias.get()[count + output] += element(last_bias_, output);
}

void PoseLayers::set_picture(const float* c, Picture& picture) const {
  reserve(picture);
  choose_units(c, picture);
  make_rows(picture);
  choose_columns(picture);
  make_few(picture);
}

void PoseLayers::run(const Picture& picture, Index poses, const float* angles, float* z, Buffers& buffers) const {
  if (buffers.poses < poses) {
    buffers.inputs = aligned_floats(poses * (units_ + angles_));
    buffers.products = aligned_floats(poses * (hidden_ + outputs_));
    buffers.poses = poses;
  }
  Parallel::shared().for_chunks(poses, kPosesAtOnce, [&](Index first, Index last, int) {
    const PackedWeights& few = picture.few;
    float* const inputs = buffers.inputs.get() + first * few.depth;
    float* const products = buffers.products.get() + first * few.n;
    write_inputs(picture, last - first, angles + first * angles_, inputs);
    packed_multiply(last - first, {inputs, few.depth, kPanel}, few, 0, panels(few.n), {}, products);
    sum_up(picture, last - first, products, z + first * outputs_);
  });
}

/// (poses, units + angles): the units that may change their sign, then the angles.
void PoseLayers::write_inputs(const Picture& picture, Index poses, const float* angles, float* inputs) const {
  const Index units = static_cast<Index>(picture.units.size());
  const float* const at = picture.units_at.data<float>();
  for (Index pose = 0; pose < poses; ++pose, angles += angles_, inputs += units + angles_) {
    std::copy_n(at, units, inputs);
    for (Index k = 0; k < angles_; ++k)
      for (Index i = 0; i < units; ++i) inputs[i] += angles[k] * at[(1 + k) * units + i];
    for (Index i = 0; i < units; ++i) inputs[i] = not_negative(inputs[i]);
    std::copy_n(angles, angles_, inputs + units);
  }
}

/// z from the products (poses, columns + outputs) with `few`. Changes the products.
void PoseLayers::sum_up(const Picture& picture, Index poses, float* products, float* z) const {
  const Index columns = static_cast<Index>(picture.columns.size());
  for (Index pose = 0; pose < poses; ++pose, products += picture.few.n, z += outputs_) {
    for (Index i = 0; i < columns; ++i) products[i] = not_negative(products[i]);
    for (Index output = 0; output < outputs_; ++output) {
      LaneSums sums;
      sums.add(products, picture.kept.data<float>() + output * columns, columns);
      z[output] = products[columns + output] + sums.total();
    }
  }
}

}  // namespace svnet::predict
