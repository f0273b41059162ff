#include "mesh_reading.h"

SVNET_FUZZ_TARGET(mesh_ply) { svnet::fuzz::read_mesh(svnet::simulation::read_ply, input); }
