#include "info/plan_text.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

#include "base/text.h"
#include "io/models/model_file.h"
#include "models/backbone.h"

namespace svnet {
namespace {

constexpr std::size_t kColumns = 6;
using Row = std::array<std::string, kColumns>;

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

Row row(const StepReport& step) {
  const bool computes = step.flops > 0 && step.milliseconds > 0;
  return {printable(step.layer),
          step.kernel,
          step.flops > 0 ? fixed(step.flops / 1e6, 2) : "-",
          fixed(step.bytes / 1e6, 2),
          fixed(step.milliseconds, 3),
          computes ? fixed(step.flops / step.milliseconds / 1e6, 1) : "-"};
}

/// Two columns of text, then numbers, two spaces apart.
std::string aligned(const std::vector<Row>& rows) {
  std::array<std::size_t, kColumns> width{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < kColumns; ++i) width[i] = std::max(width[i], row[i].size());
  std::ostringstream text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kColumns; ++i)
      text << (i == 0 ? "" : "  ") << (i < 2 ? std::left : std::right) << std::setw(static_cast<int>(width[i]))
           << row[i];
    text << "\n";
  }
  return text.str();
}

}  // namespace

std::string plan_text(const Inference& network, Index batch) {
  std::vector<Row> rows{{"layer", "kernel", "MFLOP", "MB", "ms", "GFLOP/s"}};
  StepReport total{.layer = "total", .kernel = ""};
  for (const StepReport& step : network.report(batch)) {
    rows.push_back(row(step));
    total.flops += step.flops;
    total.bytes += step.bytes;
    total.milliseconds += step.milliseconds;
  }
  rows.push_back(row(total));
  return joined(aligned(rows), "arena ", fixed(4e-6 * static_cast<double>(network.arena_size(batch)), 2),
                " MB for a batch of ", batch, " on ", Parallel::shared().threads(), " threads");
}

std::string backbone_plan(const std::string& name, const std::string& layer, Index batch,
                          const InferenceOptions& options) {
  constexpr std::uint64_t kSeed = 1;
  const bool is_int8 = options.precision == kernels::Precision::int8;
  const models::Backbone random = models::random_backbone(name, layer, kSeed, is_int8 ? InferenceOptions{} : options);
  const models::Backbone backbone = is_int8 ? models::in_int8_for_noise(random, kSeed) : random;
  return joined(name, " to ", backbone.output_name(), "\n", plan_text(backbone.network(), batch));
}

std::string model_plan(const std::filesystem::path& file, Index batch, const InferenceOptions& asked) {
  const Model model = io::read_model(file);
  const InferenceOptions options = inference_options(model, asked);
  const Inference head(model.head, model.head_parameters, model.head.output(), options);
  const std::string head_text = joined("SV-net\n", plan_text(head, batch));
  if (!frame::has_backbone(model.frame)) return head_text;
  const Graph& graph = model.backbone_graph;
  const Inference backbone(graph, model.backbone_parameters, graph.find(model.backbone_output), options);
  return joined(printable(model.backbone), " to ", printable(model.backbone_output), "\n", plan_text(backbone, batch),
                "\n\n", head_text);
}

}  // namespace svnet
