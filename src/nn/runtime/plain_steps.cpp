#include <algorithm>
#include <numeric>

#include "nn/kernels/activation/activation.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/kernels/pool/inference_pool.h"
#include "nn/runtime/plain_step.h"

namespace svnet::runtime {
namespace {

using namespace kernels;

constexpr Index kChunk = 1 << 14;

}  // namespace

StepPointer pool_step(const Window& window, bool max) {
  return plain_step(max ? "max pool" : "average pool", window.positions() * window.kh * window.kw * window.c,
                    [window, max](const StepBuffers& b) {
                      Window w = window;
                      w.n = b.batch;
                      (max ? max_pool_inference : average_pool_inference)(b.parallel, w, b.inputs[0], b.output);
                    });
}

StepPointer add_step(Index size, std::size_t inputs, Clamp clamp) {
  return plain_step("add", size * static_cast<Index>(inputs), [=, range = range_of(clamp)](const StepBuffers& b) {
    b.parallel.for_chunks(b.batch * size, kChunk, [&](Index begin, Index end, int) {
      std::copy(b.inputs[0] + begin, b.inputs[0] + end, b.output + begin);
      for (std::size_t i = 1; i < b.inputs.size(); ++i)
        for (Index j = begin; j < end; ++j) b.output[j] += b.inputs[i][j];
      if (clamp != Clamp::none)
        for (Index j = begin; j < end; ++j) b.output[j] = range.clamped(b.output[j]);
    });
  });
}

StepPointer scale_shift_step(Index rows, const Tensor& scale, const Tensor& shift, Clamp clamp) {
  const Index channels = scale.size();
  return plain_step("scale and shift", 2 * rows * channels, [=](const StepBuffers& b) {
    scale_shift(b.parallel, {b.batch * rows, channels}, b.inputs[0], scale.data<float>(), shift.data<float>(), clamp,
                b.output);
  });
}

StepPointer activation_step(Index rows, Index columns, Activation activation) {
  return with_activation(activation, [&]<class A>(A) {
    return plain_step(name_of(activation), rows * columns, [=](const StepBuffers& b) {
      if constexpr (std::is_same_v<A, Softmax>)
        b.parallel.for_chunks(b.batch * rows, 16, [&](Index begin, Index end, int) {
          for (Index row = begin; row < end; ++row)
            Softmax::row(columns, b.inputs[0] + row * columns, b.output + row * columns);
        });
      else
        b.parallel.for_chunks(b.batch * rows * columns, kChunk, [&](Index begin, Index end, int) {
          std::transform(b.inputs[0] + begin, b.inputs[0] + end, b.output + begin, A::template value<float>);
        });
    });
  });
}

StepPointer concat_step(Index rows, std::vector<Index> widths) {
  const Index total = std::accumulate(widths.begin(), widths.end(), Index{0});
  return plain_step("concat", 0, [=](const StepBuffers& b) {
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
  return plain_step("zero padding", 0, [=](const StepBuffers& b) {
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
  return plain_step("copy", 0, [=](const StepBuffers& b) { std::copy_n(b.inputs[0], b.batch * size, b.output); });
}

}  // namespace svnet::runtime
