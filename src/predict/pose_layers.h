#pragma once
#include <variant>
#include <vector>

#include "models/sv_net.h"
#include "nn/kernels/int8/int8_gemm.h"
#include "nn/runtime/inference_options.h"
#include "predict/split_graph.h"

namespace svnet::predict {

/// The three layers of a head at which the pose of the camera comes in:
///   h = relu(c + angles · A),  y = relu(h · W + b),  z = y · V + d
/// c (units) depends on the picture alone. Over the whole half-sphere most elements of h and y keep their sign: they
/// are 0, or linear in what they are made of. What these contribute to z is summed once per picture; for each pose,
/// only the elements that may change their sign are left. Immutable: several threads may share it.
class PoseLayers {
 public:
  /// Throws Error if the machine lacks the precision.
  PoseLayers(const SplitGraph& split, models::AngleEncoding angles, const InferenceOptions& options);

  Index units() const { return units_; }      ///< elements of h
  Index outputs() const { return outputs_; }  ///< elements of z

  enum class Sign : unsigned char { never_positive, never_negative, changes };

  /// One picture's part of the layers. Memory is taken once, for any picture.
  struct Picture {
    std::vector<Index> units{};     ///< the elements of h that may change their sign
    Tensor units_at{};              ///< (1 + angles, units): c and A of these, side by side
    kernels::PackedWeights rows{};  ///< (units + angles, elements of y): these give y
    std::vector<Index> columns{};   ///< the elements of y that may change their sign
    std::vector<Sign> signs{};      ///< of each element of y
    kernels::PackedWeights few{};   ///< `columns` of `rows`, then what those that are never negative give z
    Tensor summed{}, kept{};        ///< V, by columns: of those that are never negative, of `columns`

    Tensor constant{}, products{};  ///< (1 + angles, all units), (1 + angles, elements of y)
    std::vector<float> largest{};   ///< of each of `units`
    AlignedFloats scratch{};
    Index scratch_size = 0;
  };
  void set_picture(const float* c, Picture& picture) const;

  /// Buffers of run, for any picture.
  struct Buffers {
    AlignedFloats inputs{}, products{};
    Index poses = 0;
  };
  /// z (poses, outputs) of encoded angles (poses, angle_count). A row of z does not depend on the others.
  void run(const Picture& picture, Index poses, const float* angles, float* z, Buffers& buffers) const;

 private:
  void reserve(Picture& picture) const;
  void choose_units(const float* c, Picture& picture) const;
  void make_rows(Picture& picture) const;
  void choose_columns(Picture& picture) const;
  void make_few(Picture& picture) const;
  void write_inputs(const Picture& picture, Index poses, const float* angles, float* inputs) const;
  void sum_up(const Picture& picture, Index poses, float* products, float* z) const;

  models::AngleEncoding encoding_;
  Index units_, hidden_, outputs_, angles_;
  Tensor angle_kernel_;                                                // A
  std::vector<models::AngleRange> ranges_{};                           // of angles · A, of each unit
  std::variant<kernels::PackedWeights, kernels::PackedInt8> weights_;  // W
  Tensor bias_, last_kernel_, last_bias_;                              // b, V, d
};

}  // namespace svnet::predict
