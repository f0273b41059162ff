// make_attacks FOLDER: writes the corpus of attack_test, hdf5/NAME.h5 and meshes/NAME/things/, and names the files.
#include <iostream>

#include "attacks.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: make_attacks FOLDER\n", 2;
  using namespace svnet::attacks;
  const std::filesystem::path folder = argv[1];
  for (const auto& attacks : {write_hdf5_attacks(folder / "hdf5"), write_mesh_attacks(folder / "meshes")})
    for (const Attack& attack : attacks) std::cout << attack.file.string() << "\n";
}
