// A model file through the C interface: load it, embed an image, score poses. Every status is an answer, but
// SVNET_INTERNAL_ERROR, which stands for "anything else".
#include <vector>

#include "memory_file.h"
#include "svnet/svnet.h"

using namespace svnet::fuzz;

namespace {

void check_status(svnet_status status) {
  if (status == SVNET_INTERNAL_ERROR) report(svnet_last_error());
  if (status != SVNET_OK) check_message(svnet_last_error());
}

void use(const svnet_model* model) {
  constexpr std::int32_t kSide = 24;
  std::vector<std::uint8_t> pixels(kSide * kSide * 3, 200);
  for (std::size_t i = 0; i < pixels.size() / 3; i += 2) pixels[i] = static_cast<std::uint8_t>(i);
  const std::vector<float> depth(kSide * kSide, 0.5f);
  std::vector<float> features(svnet_feature_count(model));
  const svnet_status status =
      svnet_embed_with_depth(model, pixels.data(), kSide, kSide, kSide * 3, SVNET_RGB8, depth.data(), features.data());
  check_status(status);
  if (status != SVNET_OK) return;
  const double poses[] = {90, 90, 30, 45, 200, 0};
  float scores[3];
  check_status(svnet_score(model, features.data(), poses, 3, scores));
}

}  // namespace

SVNET_FUZZ_TARGET(c_api) {
  svnet_set_threads(1);
  const MemoryFile file(input);
  svnet_model* model = nullptr;
  const svnet_status status = svnet_model_load(file.path().c_str(), &model);
  check_status(status);
  if ((status == SVNET_OK) != (model != nullptr)) report("a status that does not fit the model");
  if (model != nullptr) use(model);
  svnet_model_free(model);
}
