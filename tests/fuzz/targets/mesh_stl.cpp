#include "mesh_reading.h"

SVNET_FUZZ_TARGET(mesh_stl) { svnet::fuzz::read_mesh(svnet::simulation::read_stl, input); }
