#include "train/network_head.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "nn/graph/run.h"
#include "nn/ops/dense.h"
#include "nn/ops/losses.h"
#include "nn/optim/schedule.h"
#include "train/epoch_order.h"
#include "train/pose_examples.h"
#include "train/training_step.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

/// Means and standard deviations of the columns of the inputs; a deviation of 0 becomes 1.
struct Standard {
  std::vector<double> mean, deviation;
};

Standard standard_of(const PoseExamples& e) {
  const auto inputs = static_cast<std::size_t>(e.inputs);
  const auto count = static_cast<double>(e.y.size());
  Standard s{std::vector<double>(inputs), std::vector<double>(inputs)};
  for (std::size_t i = 0; i < e.x.size(); ++i) s.mean[i % inputs] += e.x[i] / count;
  for (std::size_t i = 0; i < e.x.size(); ++i) {
    const double off = e.x[i] - s.mean[i % inputs];
    s.deviation[i % inputs] += off * off / count;
  }
  for (double& deviation : s.deviation) deviation = deviation > 1e-12 ? std::sqrt(deviation) : 1;
  return s;
}

/// A batch of whole poses. `centring` (B, B) times a column subtracts the weighted mean of each pose, and multiplies by
/// the square root of the weight.
struct Batch {
  Tensor inputs, centring, targets;
};

Batch batch_of(const PoseExamples& e, const Standard& standard, std::span<const PoseRange> poses, double y_deviation,
               double noise, RandomStream& random) {
  Index count = 0;
  for (const auto& [begin, end] : poses) count += static_cast<Index>(end - begin);
  Batch batch{Tensor::empty({count, e.inputs}), Tensor::zeros({count, count}), Tensor::zeros({count, 1})};
  const auto columns = static_cast<std::size_t>(e.inputs);
  float* x = batch.inputs.data<float>();
  Index first = 0;  // the row where the pose begins
  for (const auto& [begin, end] : poses) {
    double sum = 0, mean_y = 0;
    for (std::size_t i = begin; i < end; ++i) {
      sum += e.weight[i];
      mean_y += e.weight[i] * e.y[i];
    }
    mean_y /= sum;
    for (std::size_t i = begin; i < end; ++i) {
      const Index row = first + static_cast<Index>(i - begin);
      const double root = std::sqrt(e.weight[i]);
      batch.targets.data<float>()[row] = static_cast<float>(root * (e.y[i] - mean_y) / y_deviation);
      for (std::size_t j = begin; j < end; ++j)
        batch.centring.data<float>()[row * count + first + static_cast<Index>(j - begin)] =
            static_cast<float>(root * ((i == j ? 1 : 0) - e.weight[j] / sum));
      for (std::size_t c = 0; c < columns; ++c)
        *x++ = static_cast<float>((e.x[i * columns + c] - standard.mean[c]) / standard.deviation[c] +
                                  noise * random.normal());
    }
    first += static_cast<Index>(end - begin);
  }
  return batch;
}

/// The standard deviation of y within poses; 1 if it is 0.
double deviation_within_poses(const PoseExamples& e) {
  const double variance = variance_within_poses(e.y, e.pose);
  return variance > 0 ? std::sqrt(variance) : 1;
}

/// Makes the network take inputs as they are and return y.
void take_units(Parameters& parameters, const Standard& standard, double y_deviation) {
  Tensor &kernel = parameters.at("dense1/kernel"), &bias = parameters.at("dense1/bias");
  const Index width = bias.size();
  for (Index unit = 0; unit < width; ++unit) {
    double moved = 0;
    for (std::size_t i = 0; i < standard.mean.size(); ++i) {
      float& weight = kernel.data<float>()[static_cast<Index>(i) * width + unit];
      weight = static_cast<float>(weight / standard.deviation[i]);
      moved += weight * standard.mean[i];
    }
    bias.data<float>()[unit] -= static_cast<float>(moved);
  }
  for (const char* name : {"out/kernel", "out/bias"}) {
    Tensor& tensor = parameters.at(name);
    for (Index i = 0; i < tensor.size(); ++i)
      tensor.data<float>()[i] = static_cast<float>(tensor.data<float>()[i] * y_deviation);
  }
}

}  // namespace

Parameters fit_network(const PoseExamples& examples, const NetworkFitOptions& options) {
  const Graph graph = models::pose_network(examples.inputs, options.network);
  Parameters parameters = initial_parameters(graph, options.seed);
  const Standard standard = standard_of(examples);
  const double y_deviation = deviation_within_poses(examples);
  const std::vector<PoseRange> poses = pose_ranges(examples.pose);
  const auto count = static_cast<Index>(poses.size());
  const Index steps = options.epochs * batch_count(options.poses_per_batch, count), warm_up = steps / 4;
  const Schedule schedule{
      .kind = Schedule::Kind::cosine, .base = options.learning_rate, .total = steps - warm_up, .warm_up = warm_up};
  const auto optimizer = adam(trainable(graph, parameters), {.weight_decay = options.weight_decay});
  for (Index epoch = 0; epoch < options.epochs; ++epoch) {
    const auto order = epoch_order(count, options.seed, epoch);
    for (Index begin = 0, end; begin < count; begin = end) {
      end = batch_end(begin, options.poses_per_batch, count);
      std::vector<PoseRange> chosen;
      for (Index i = begin; i < end; ++i)
        chosen.push_back(poses[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
      RandomStream random(options.seed, Stream::augmentation, static_cast<std::uint64_t>(optimizer->steps));
      const Batch batch = batch_of(examples, standard, chosen, y_deviation, options.input_noise, random);
      const auto loss = [&](const Tensor& out) {
        return ops::mean_squared_error(ops::dense(batch.centring, out), batch.targets);
      };
      training_step(graph, parameters, *optimizer, {batch.inputs}, loss,
                    {.learning_rate = schedule.at(optimizer->steps), .seed = options.seed});
    }
  }
  take_units(parameters, standard, y_deviation);
  const std::vector<double> predicted = network_predictions(parameters, examples, options.network);
  const double mean = std::accumulate(predicted.begin(), predicted.end(), 0.0) / static_cast<double>(predicted.size());
  parameters.at("out/bias").data<float>()[0] -= static_cast<float>(mean);
  return parameters;
}

std::vector<double> network_predictions(const Parameters& parameters, const PoseExamples& examples,
                                        const models::PoseNetworkOptions& options) {
  const Graph graph = models::pose_network(examples.inputs, options);
  const auto count = static_cast<Index>(examples.x.size()) / examples.inputs;
  constexpr Index kBatch = 4096;
  std::vector<double> predicted;
  for (Index begin = 0; begin < count; begin += kBatch) {
    const Index size = std::min(kBatch, count - begin);
    Tensor inputs = Tensor::empty({size, examples.inputs});
    const double* x = examples.x.data() + begin * examples.inputs;
    std::transform(x, x + inputs.size(), inputs.data<float>(), [](double value) { return static_cast<float>(value); });
    const Tensor out = run_inference(graph, parameters, {inputs}, {graph.output()})[0];
    const auto values = out.values<float>();
    predicted.insert(predicted.end(), values.begin(), values.end());
  }
  return predicted;
}

}  // namespace svnet::train
