#include "train/stages/evaluation_options.h"

namespace svnet::train {

EvaluationOptions evaluation_options(const Config& config, std::uint64_t problems) {
  EvaluationOptions options{.problems = problems,
                            .seed = static_cast<std::uint64_t>(config.seed),
                            .nmi = config.evaluation.nmi,
                            .fusion = config.evaluation.fusion};
  if (config.evaluation.views > 1) options.baselines.emplace_back("svnet");
  for (Index views = 2; views <= config.evaluation.views; ++views)
    for (const char* selector : {"rand", "svnet", "top_svnet"})
      options.baselines.push_back(name_with_views(selector, views));
  return options;
}

}  // namespace svnet::train
