#include "mesh_reading.h"

SVNET_FUZZ_TARGET(mesh_obj) { svnet::fuzz::read_mesh(svnet::simulation::read_obj, input); }
