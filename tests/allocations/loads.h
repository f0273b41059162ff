#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "failing_malloc.h"

namespace svnet::allocations {

/// Something that is loaded, or written, while allocations fail.
struct Load {
  std::string name;
  /// The same number whenever it succeeds. Throws std::bad_alloc or Error.
  std::function<std::uint64_t()> run;
  Where where = Where::here;
  /// Whether each attempt needs a process of its own, because a library does not work any more after one.
  bool is_alone = false;
  /// Whether the compiler puts a destructor of nlohmann::json into a function of svnet's own, so that a crash in it
  /// cannot be told from one of svnet's.
  bool destroys_json = false;
  /// What is wrong afterwards, such as a partial file; empty if nothing is.
  std::function<std::string()> problem = [] { return std::string(); };
};

/// Every format. `seeds`: what fuzz_seeds wrote. `work`: an empty folder.
std::vector<Load> all_loads(const std::filesystem::path& seeds, const std::filesystem::path& work);

}  // namespace svnet::allocations
