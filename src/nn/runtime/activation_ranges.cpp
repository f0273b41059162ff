#include "nn/runtime/activation_ranges.h"

#include "base/sha256.h"

namespace svnet {

std::string fingerprint(const ActivationRanges& ranges) {
  Sha256 hash;
  const auto add = [&](const auto& values) {
    hash.update_field(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])));
  };
  hash.update_field("activation ranges 1");
  for (const auto& [layer, of_layer] : ranges) {
    hash.update_field(layer);
    add(of_layer.low);
    add(of_layer.high);
    add(of_layer.mean);
  }
  return hash.hex();
}

}  // namespace svnet
