#pragma once
#include "fuzz_target.h"
#include "simulation/meshes/mesh_readers.h"

namespace svnet::fuzz {

/// Reads a mesh whose folder does not exist: every file that it names is missing.
inline void read_mesh(void (*reader)(std::string_view, const simulation::CollectionFiles&, simulation::MeshDraft&),
                      Bytes input) {
  accept([&] {
    simulation::MeshDraft draft("input");
    const auto ignore = [](const std::string& line) { check_message(line); };
    reader(text_of(input), simulation::CollectionFiles("/nowhere/input", "", ignore), draft);
    std::move(draft).finish([](double) { return 1.0; });
  });
}

}  // namespace svnet::fuzz
