#include "train/validation_categories.h"

#include "base/error.h"
#include "base/random.h"

namespace svnet::train {

std::vector<bool> validation_categories(const std::vector<bool>& held_out, const Config& config) {
  std::vector<std::int32_t> candidates;
  for (std::size_t c = 0; c < held_out.size(); ++c)
    if (!held_out[c]) candidates.push_back(static_cast<std::int32_t>(c));
  const auto count = static_cast<Index>(candidates.size());
  const Index wanted = config.training.validation_categories;
  check(wanted <= count - 2, "training.validation_categories: ", wanted, " of ", count,
        " training categories leave fewer than 2 to train on");
  RandomStream random(static_cast<std::uint64_t>(config.seed), Stream::cross_validation);
  draw_without_replacement(random, candidates.data(), count, wanted);
  std::vector<bool> chosen(held_out.size(), false);
  for (Index i = 0; i < wanted; ++i) chosen[static_cast<std::size_t>(candidates[static_cast<std::size_t>(i)])] = true;
  return chosen;
}

CategoryUse category_use(const std::vector<bool>& held_out, const Config& config) {
  CategoryUse use{.learnt = held_out, .validate = std::vector<bool>(held_out.size(), false)};
  if (config.sv_net.frame == frame::FrameChoice::camera) use.validate = validation_categories(held_out, config);
  for (std::size_t c = 0; c < held_out.size(); ++c) use.learnt[c] = !held_out[c] && !use.validate[c];
  return use;
}

}  // namespace svnet::train
