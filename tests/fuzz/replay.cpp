// fuzz_replay FOLDER...: runs every input FOLDER/<target>/* through its target, in order of the names. Prints each
// before it runs, so that the last line names what a finding is about.
#include <algorithm>
#include <iostream>
#include <map>
#include <vector>

#include "fuzz_target.h"
#include "regression_file.h"

namespace svnet::fuzz {
namespace {

std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".dict") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The input in memory of exactly its size, so that sanitizers see reads past its end.
void run(Target target, const std::string& input) {
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());
  target(bytes);
}

}  // namespace

Registration::Registration(const char* name, Target target) { targets()[name] = target; }

}  // namespace svnet::fuzz

int main(int argc, char** argv) {
  using namespace svnet::fuzz;
  int count = 0;
  for (int i = 1; i < argc; ++i)
    for (const auto& file : files_in(argv[i])) {
      const std::string name = file.parent_path().filename().string();
      const auto target = targets().find(name);
      if (target == targets().end()) {
        std::cerr << file.string() << ": there is no target '" << name << "'\n";
        return 1;
      }
      std::cout << file.string() << std::endl;  // the last line names what a finding is about
      run(target->second, regression_input(file));
      ++count;
    }
  std::cout << count << " inputs, no findings\n";
  return count > 0 ? 0 : 1;
}
