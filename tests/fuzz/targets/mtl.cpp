#include "fuzz_target.h"
#include "simulation/meshes/mtl_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(mtl) {
  accept([&] {
    for (const simulation::MtlMaterial& material : simulation::parse_mtl(text_of(input)))
      simulation::texture_factor(material);
  });
}
