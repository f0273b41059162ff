#include "mesh_reading.h"

SVNET_FUZZ_TARGET(mesh_gltf) { svnet::fuzz::read_mesh(svnet::simulation::read_gltf, input); }
