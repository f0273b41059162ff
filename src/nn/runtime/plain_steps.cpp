#include <algorithm>
#include <numeric>

#include "nn/kernels/activation/activation.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/kernels/pool/inference_pool.h"
#include "nn/runtime/step.h"

namespace svnet::runtime {
namespace {

using namespace kernels;

constexpr Index kChunk = 1 << 14;

/// A step that is one function of its buffers.
template <class Body>
class Plain : public Step {
 public:
  Plain(std::string kernel, double flops, Body body)
      : kernel_(std::move(kernel)), flops_(flops), body_(std::move(body)) {}
  void run(const StepBuffers& buffers) const override { body_(buffers); }
  std::string kernel() const override { return kernel_; }
  double flops() const override { return flops_; }

 private:
  std::string kernel_;
  double flops_;
  Body body_;
};

template <class Body>
StepPointer plain(std::string kernel, Index flops, Body body) {
  return std::make_unique<Plain<Body>>(std::move(kernel), static_cast<double>(flops), std::move(body));
}

float clamped(float y, Clamp clamp) {
  if (clamp != Clamp::none && y < 0.0f) y = 0.0f;
  return clamp == Clamp::relu6 && y > 6.0f ? 6.0f : y;
}

}  // namespace

StepPointer pool_step(const Window& window, bool max) {
  return plain(max ? "max pool" : "average pool", window.positions() * window.kh * window.kw * window.c,
               [window, max](const StepBuffers& b) {
                 Window w = window;
                 w.n = b.batch;
                 (max ? max_pool_inference : average_pool_inference)(b.parallel, w, b.inputs[0], b.output);
               });
}

StepPointer add_step(Index size, std::size_t inputs, Clamp clamp) {
  return plain("add", size * static_cast<Index>(inputs), [size, clamp](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * size, kChunk, [&](Index begin, Index end, int) {
      std::copy(b.inputs[0] + begin, b.inputs[0] + end, b.output + begin);
      for (std::size_t i = 1; i < b.inputs.size(); ++i)
        for (Index j = begin; j < end; ++j) b.output[j] += b.inputs[i][j];
      if (clamp != Clamp::none)
        for (Index j = begin; j < end; ++j) b.output[j] = clamped(b.output[j], clamp);
    });
  });
}

StepPointer scale_shift_step(Index rows, const Tensor& scale, const Tensor& shift, Clamp clamp) {
  const Index channels = scale.size();
  return plain("scale and shift", 2 * rows * channels, [=](const StepBuffers& b) {
    scale_shift(b.parallel, {b.batch * rows, channels}, b.inputs[0], scale.data<float>(), shift.data<float>(), clamp,
                b.output);
  });
}

StepPointer clamp_step(Index size, Clamp clamp) {
  return plain(clamp == Clamp::relu ? "relu" : "relu6", size, [=](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * size, kChunk, [&](Index begin, Index end, int) {
      std::transform(b.inputs[0] + begin, b.inputs[0] + end, b.output + begin,
                     [clamp](float v) { return clamped(v, clamp); });
    });
  });
}

StepPointer sigmoid_step(Index size) {
  return plain("sigmoid", size, [=](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * size, kChunk, [&](Index begin, Index end, int) {
      std::transform(b.inputs[0] + begin, b.inputs[0] + end, b.output + begin, sigmoid<float>);
    });
  });
}

StepPointer softmax_step(Index rows, Index classes) {
  return plain("softmax", rows * classes, [=](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * rows, 16, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row)
        softmax_row(classes, b.inputs[0] + row * classes, b.output + row * classes);
    });
  });
}

StepPointer concat_step(Index rows, std::vector<Index> widths) {
  const Index total = std::accumulate(widths.begin(), widths.end(), Index{0});
  return plain("concat", 0, [=](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * rows, 64, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row) {
        float* to = b.output + row * total;
        for (std::size_t i = 0; i < widths.size(); ++i) to = std::copy_n(b.inputs[i] + row * widths[i], widths[i], to);
      }
    });
  });
}

StepPointer padding_step(Index h, Index w, Index c, const Padding& p) {
  const Index height = h + p.top + p.bottom, width = (w + p.left + p.right) * c;
  return plain("zero padding", 0, [=](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * height, 8, [&](Index begin, Index end, int) {
      for (Index row = begin; row < end; ++row) {
        float* to = b.output + row * width;
        const Index from = row % height - p.top;
        std::fill_n(to, width, 0.0f);
        if (from >= 0 && from < h) std::copy_n(b.inputs[0] + (row / height * h + from) * w * c, w * c, to + p.left * c);
      }
    });
  });
}

StepPointer copy_step(Index size) {
  return plain("copy", 0, [=](const StepBuffers& b) { std::copy_n(b.inputs[0], b.batch * size, b.output); });
}

}  // namespace svnet::runtime
