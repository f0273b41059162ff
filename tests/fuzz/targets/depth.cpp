#include "fuzz_target.h"
#include "io/images/depth_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(depth) {
  accept([&] {
    const DepthImage image = io::decode_depth("input", input);
    if (image.metres.size() != static_cast<std::size_t>(image.height * image.width)) report("pixels are missing");
    for (const float z : image.metres)
      if (!(z >= 0 && z < 100)) report("a depth that is out of range");
  });
  accept([&] { io::decode_depth("input", input, 0.0001); });
}
