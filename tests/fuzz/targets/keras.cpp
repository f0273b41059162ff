#include "io/keras/keras_weights.h"
#include "memory_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(keras) {
  const MemoryFile file(input);
  accept([&] {
    const io::KerasWeightsFile weights(file.path());
    for (const io::KerasLayer& layer : weights.layers())
      for (const io::KerasArray& array : layer.arrays) accept([&] { weights.values(array); });
  });
}
