#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bar_dataset.h"
#include "shell.h"

namespace svnet {

/// A folder with the dataset of bars and a configuration, and commands that run in it.
class BarPlace {
 public:
  BarPlace() {
    write_bar_dataset(folder.path() / "data", true);
    folder.write("config.yaml", R"(preset: best
seed: 3
dataset:
  root: data
scores:
  backbone: tiny_xception
  problems: 300
  rounds: 0
  min_categories: 2
evaluation:
  problems: 60
)");
  }
  Ran run(const std::string& command) const {
    return run_shell(folder.path(), "export PATH=" PROGRAMS ":$PATH && " + command);
  }
  /// Requires exit 0 and an empty stderr.
  std::string output_of(const std::string& command) const {
    const Ran ran = run(command);
    INFO(command << "\n" << ran.err);
    REQUIRE(ran.status == 0);
    REQUIRE(ran.err.empty());
    return ran.out;
  }
  /// Requires exit 1, no results, and one line of stderr, which it returns.
  std::string error_of(const std::string& command) const {
    const Ran ran = run(command);
    INFO(command);
    CHECK(ran.status == 1);
    CHECK(ran.out.empty());
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    return ran.err;
  }
  nlohmann::json json(const std::string& file) const {
    return nlohmann::json::parse(file_contents(folder.path() / file));
  }

  TemporaryFolder folder;
};

}  // namespace svnet
