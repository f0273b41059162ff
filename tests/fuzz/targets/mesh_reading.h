#pragma once
#include "base/error.h"
#include "fuzz_target.h"
#include "simulation/meshes/mesh_files.h"
#include "simulation/meshes/mesh_readers.h"

namespace svnet::fuzz {

/// Every file that a mesh names is missing.
class NoFiles : public simulation::MeshFiles {
 public:
  NoFiles() : MeshFiles("/nowhere/input") {}
  std::optional<std::filesystem::path> find(const char*, const std::string&) const override { return {}; }
  std::string contents(const std::filesystem::path& found) const override {
    fail(found.string(), ": was not found, so it is not read");
  }
  void warn(const std::string& text) const override { check_message(text); }
};

inline void read_mesh(void (*reader)(std::string_view, const simulation::MeshFiles&, simulation::MeshDraft&),
                      Bytes input) {
  accept([&] {
    simulation::MeshDraft draft("input");
    reader(text_of(input), NoFiles(), draft);
    std::move(draft).finish([](double) { return 1.0; });
  });
}

}  // namespace svnet::fuzz
