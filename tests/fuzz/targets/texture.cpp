// Textures of meshes: also BMP, TGA, TIFF and GIF. The first byte chooses the name, by which a TGA is told.
#include "fuzz_target.h"
#include "io/images/texture_image.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(texture) {
  if (input.empty()) return;
  accept([&] { io::decode_texture(input[0] % 2 == 0 ? "input.tga" : "input.png", input.subspan(1)); });
}
