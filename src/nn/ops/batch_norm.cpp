#include "nn/ops/batch_norm.h"

#include <cmath>
#include <vector>

#include "nn/autograd.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/kernels/batch_norm/channel_norm.h"
#include "nn/ops/checks.h"

namespace svnet::ops {
namespace {

void check_channels(const char* op, const Tensor& x, std::initializer_list<Tensor> parameters) {
  for (const Tensor& p : parameters) {
    check_operands(op, {x, p});
    check(p.rank() == 1 && p.dim(0) == x.dim(-1), "[", op, "] input has ", x.dim(-1), " channels, a parameter has ",
          to_string(p.shape()));
  }
}

/// 1 / √(variance + ε).
Tensor inverse_deviation(const Tensor& variance, double epsilon) {
  Tensor inverse = Tensor::empty(variance.shape(), variance.dtype());
  with_dtype(variance.dtype(), [&]<class T>() {
    for (Index c = 0; c < variance.size(); ++c)
      inverse.data<T>()[c] = static_cast<T>(1.0 / std::sqrt(static_cast<double>(variance.data<T>()[c]) + epsilon));
  });
  return inverse;
}

/// The batch norm of x (…, C) with mean (C) and inverse = 1 / √(variance + ε) (C).
Tensor normalised(const Tensor& x, const Tensor& gamma, const Tensor& beta, const Tensor& mean, const Tensor& inverse,
                  Index rows) {
  const Index channels = x.dim(-1);
  Tensor y = Tensor::empty(x.shape(), x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    std::vector<T> scale(static_cast<std::size_t>(channels)), shift(scale.size());
    for (Index c = 0; c < channels; ++c) {
      const kernels::ChannelNorm norm{.mean = mean.data<T>()[c],
                                      .scale = static_cast<double>(gamma.data<T>()[c]) * inverse.data<T>()[c],
                                      .beta = beta.data<T>()[c]};
      scale[static_cast<std::size_t>(c)] = static_cast<T>(norm.scale);
      shift[static_cast<std::size_t>(c)] = static_cast<T>(norm.shift());
    }
    kernels::scale_shift(thread_pool(), {.rows = rows, .channels = channels}, x.data<T>(), scale.data(), shift.data(),
                         kernels::Clamp::none, y.data<T>());
  });
  return y;
}

/// Moves `moving` towards correction · batch.
void update_moving_statistics(Tensor& moving, const Tensor& batch, double correction, const BatchNormOptions& o) {
  const double keep = o.convention == MomentumConvention::keras ? o.momentum : 1 - o.momentum;
  with_dtype(moving.dtype(), [&]<class T>() {
    for (Index c = 0; c < moving.size(); ++c)
      moving.data<T>()[c] = static_cast<T>(keep * moving.data<T>()[c] + (1 - keep) * correction * batch.data<T>()[c]);
  });
}

/// Σ dy and Σ dy·(x − mean)·inverse over the rows: the gradients of beta and gamma.
struct ChannelGradients {
  Tensor beta, gamma;
};

template <class T>
ChannelGradients channel_gradients(const Tensor& x, const Tensor& mean, const Tensor& inverse, const Tensor& dy,
                                   Index rows) {
  const Index channels = x.dim(-1);
  const kernels::RowsShape shape{.rows = rows, .channels = channels};
  Tensor hat = Tensor::empty(x.shape(), x.dtype());
  std::vector<T> shift(static_cast<std::size_t>(channels));
  for (Index c = 0; c < channels; ++c) shift[static_cast<std::size_t>(c)] = -mean.data<T>()[c] * inverse.data<T>()[c];
  kernels::scale_shift(thread_pool(), shape, x.data<T>(), inverse.data<T>(), shift.data(), kernels::Clamp::none,
                       hat.data<T>());
  ChannelGradients sums{Tensor::empty({channels}, x.dtype()), Tensor::empty({channels}, x.dtype())};
  kernels::column_sums<T>(thread_pool(), shape, dy.data<T>(), nullptr, sums.beta.data<T>());
  kernels::column_sums<T>(thread_pool(), shape, dy.data<T>(), hat.data<T>(), sums.gamma.data<T>());
  return sums;
}

/// dx = scale_c · (dy − offset_c − slope_c · x), per channel.
template <class T>
Tensor input_gradient(const Tensor& x, const Tensor& dy, const std::vector<T>& scale, const std::vector<T>& offset,
                      const std::vector<T>& slope) {
  const Index channels = x.dim(-1);
  Tensor dx = Tensor::empty(x.shape(), x.dtype());
  const T *values = x.data<T>(), *from = dy.data<T>();
  T* to = dx.data<T>();
  thread_pool().for_chunks(x.size() / channels, 64, [&](Index begin, Index end, int) {
    for (Index row = begin; row < end; ++row)
      for (Index c = 0; c < channels; ++c) {
        const auto j = static_cast<std::size_t>(c);
        const Index i = row * channels + c;
        to[i] = scale[j] * (from[i] - offset[j] - slope[j] * values[i]);
      }
  });
  return dx;
}

}  // namespace

Tensor batch_norm_training(const Tensor& x, const Tensor& gamma, const Tensor& beta, Tensor& moving_mean,
                           Tensor& moving_variance, const BatchNormOptions& options) {
  const Index rows = leading("batch_norm", x), channels = x.dim(-1);
  check_channels("batch_norm", x, {gamma, beta, moving_mean, moving_variance});
  check(rows >= 2, "[batch_norm] training needs at least 2 values per channel, got ", to_string(x.shape()));
  Tensor mean = Tensor::empty({channels}, x.dtype()), variance = Tensor::empty({channels}, x.dtype());
  with_dtype(x.dtype(), [&]<class T>() {
    kernels::moments<T>(thread_pool(), {.rows = rows, .channels = channels}, x.data<T>(), mean.data<T>(),
                        variance.data<T>());
  });
  const auto n = static_cast<double>(rows);
  update_moving_statistics(moving_mean, mean, 1.0, options);
  update_moving_statistics(moving_variance, variance,
                           options.convention == MomentumConvention::pytorch ? n / (n - 1) : 1.0, options);

  const Tensor inverse = inverse_deviation(variance, options.epsilon);
  return autograd::record(
      normalised(x, gamma, beta, mean, inverse, rows), {x, gamma, beta},
      [=, x = x.detached(), gamma = gamma.detached()](const Tensor& dy, autograd::Gradients& g) {
        with_dtype(dy.dtype(), [&]<class T>() {
          const auto sums = channel_gradients<T>(x, mean, inverse, dy, rows);
          g.add(1, sums.gamma);
          g.add(2, sums.beta);
          if (!g.wants(0)) return;
          // dx = gamma·inverse · (dy − mean(dy) − hat·mean(dy·hat)), with hat = (x − mean)·inverse.
          std::vector<T> scale, offset, slope;
          for (Index c = 0; c < channels; ++c) {
            const T i = inverse.data<T>()[c], along = sums.gamma.template data<T>()[c] / static_cast<T>(rows);
            scale.push_back(gamma.data<T>()[c] * i);
            slope.push_back(i * along);
            offset.push_back(sums.beta.template data<T>()[c] / static_cast<T>(rows) - mean.data<T>()[c] * i * along);
          }
          g.add(0, input_gradient<T>(x, dy, scale, offset, slope));
        });
      });
}

Tensor batch_norm_inference(const Tensor& x, const Tensor& gamma, const Tensor& beta, const Tensor& mean,
                            const Tensor& variance, double epsilon) {
  const Index rows = leading("batch_norm", x), channels = x.dim(-1);
  check_channels("batch_norm", x, {gamma, beta, mean, variance});
  const Tensor inverse = inverse_deviation(variance, epsilon);
  return autograd::record(normalised(x, gamma, beta, mean, inverse, rows), {x, gamma, beta},
                          [=, x = x.detached(), gamma = gamma.detached(), mean = mean.detached()](
                              const Tensor& dy, autograd::Gradients& g) {
                            with_dtype(dy.dtype(), [&]<class T>() {
                              if (g.wants(1) || g.wants(2)) {
                                const auto sums = channel_gradients<T>(x, mean, inverse, dy, rows);
                                g.add(1, sums.gamma);
                                g.add(2, sums.beta);
                              }
                              if (!g.wants(0)) return;
                              const std::vector<T> zeros(static_cast<std::size_t>(channels), T{0});
                              std::vector<T> scale;
                              for (Index c = 0; c < channels; ++c)
                                scale.push_back(gamma.data<T>()[c] * inverse.data<T>()[c]);
                              g.add(0, input_gradient<T>(x, dy, scale, zeros, zeros));
                            });
                          });
}

}  // namespace svnet::ops
