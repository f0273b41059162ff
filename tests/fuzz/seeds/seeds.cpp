// fuzz_seeds FOLDER [REGRESSIONS]: makes the seeds and dictionaries of all targets anew. REGRESSIONS/<target>/* are
// seeds too.
#include "seeds.h"

#include <fstream>
#include <iostream>

#include "regression_file.h"

namespace svnet::fuzz {

namespace fs = std::filesystem;

fs::path Seeds::path(const std::string& target, const std::string& name) const {
  fs::create_directories(folder_ / target);
  return folder_ / target / name;
}

void Seeds::add(const std::string& target, const std::string& name, std::string_view contents) const {
  std::ofstream file(path(target, name), std::ios::binary);
  file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  if (!file.flush()) throw std::runtime_error("cannot write the seed " + name);
}

void Seeds::copy(const std::string& target, const std::string& fixtures, std::string_view ending,
                 std::string_view before) const {
  for (const auto& entry : fs::directory_iterator(fs::path(SVNET_FIXTURES) / fixtures)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(ending)) add(target, name, std::string(before) + regression_input(entry.path()));
  }
}

void Seeds::add_word(const std::string& target, std::string_view word) const {
  std::ofstream file(folder_ / (target + ".dict"), std::ios::app);
  file << '"';
  for (const char c : word)
    if (c == '"' || c == '\\')
      file << '\\' << c;
    else if (static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f)
      file << c;
    else
      file << "\\x"
           << "0123456789ABCDEF"[static_cast<unsigned char>(c) >> 4] << "0123456789ABCDEF"[c & 15];
  file << "\"\n";
}

}  // namespace svnet::fuzz

int main(int argc, char** argv) {
  using namespace svnet::fuzz;
  if (argc < 2) {
    std::cerr << "fuzz_seeds FOLDER [REGRESSIONS]\n";
    return 2;
  }
  fs::remove_all(argv[1]);
  const Seeds seeds(argv[1]);
  add_documents(seeds);
  add_meshes(seeds);
  add_models(seeds);
  add_pictures(seeds);
  add_requests(seeds);
  if (argc > 2)
    for (const auto& entry : fs::recursive_directory_iterator(argv[2]))
      if (entry.is_regular_file())
        seeds.add(entry.path().parent_path().filename().string(), "regression-" + entry.path().filename().string(),
                  regression_input(entry.path()));
}
