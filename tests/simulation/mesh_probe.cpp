// mesh_probe FILE...: a JSON object per line of what read_mesh makes of each file, for tests/oracle/test_meshes.py.
#include <iostream>
#include <nlohmann/json.hpp>

#include "mesh_look.h"
#include "simulation/meshes/mesh_file.h"

int main(int argc, char** argv) {
  using namespace svnet;
  using namespace svnet::simulation;
  for (int i = 1; i < argc; ++i) {
    nlohmann::json line{{"file", argv[i]}, {"warnings", nlohmann::json::array()}};
    try {
      MeshReading reading;
      reading.collection = std::filesystem::path(argv[i]).parent_path().parent_path();
      reading.warn = [&](const std::string& text) { line["warnings"].push_back(text); };
      const Mesh mesh = read_mesh(argv[i], reading);
      Eigen::AlignedBox3f box;
      for (const Vec3& point : mesh.points) box.extend(point);
      const MeshLook look = look_of(mesh);
      line["size"] = {box.sizes().x(), box.sizes().y(), box.sizes().z()};
      line["colour"] = {look.srgb.x(), look.srgb.y(), look.srgb.z()};
      line["metal"] = look.metal;
      line["triangles"] = mesh.triangles.size();
    } catch (const std::exception& error) {
      line["error"] = error.what();
    }
    std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  }
}
