#include "run_config.h"

#include "base/error.h"

namespace svnet::command {
namespace fs = std::filesystem;

fs::path config_file_of(const fs::path& run_folder) {
  check(fs::is_directory(run_folder), run_folder.string(), ": no such run folder");
  fs::path config = fs::canonical(run_folder) / "config.yaml";
  check(fs::exists(config), run_folder.string(),
        ": is no run folder, it has no config.yaml; svnet-train and svnet-crossval make one");
  return config;
}

void check_data_exist(const train::Config& config) {
  check(fs::exists(config.dataset.root), config.dataset.root.string(),
        ": no such folder; if the data set was moved, say where it is by --set dataset.root=DIR");
}

}  // namespace svnet::command
