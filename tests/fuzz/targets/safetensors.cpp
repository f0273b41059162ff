#include "io/tensors/safetensors.h"

#include "fuzz_target.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(safetensors) {
  accept([&] {
    const io::SafetensorsFile file("input", std::as_bytes(input));
    std::uint64_t sum = 0;
    for (const io::SafetensorsTensor& tensor : file.tensors()) {
      for (const std::byte byte : tensor.bytes) sum += std::to_integer<std::uint64_t>(byte);
      if (file.find(tensor.name) != &tensor) report("a tensor that is not found by its name");
    }
    if (sum > 255 * input.size()) report("more bytes than the file has");
  });
}
