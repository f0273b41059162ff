#include "sources.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>

namespace svnet {
namespace {

namespace fs = std::filesystem;

/// The file in quotes of an #include line.
std::optional<std::string> quoted_include(const std::string& line) {
  constexpr std::string_view kStart = "#include \"";
  if (!line.starts_with(kStart)) return std::nullopt;
  return line.substr(kStart.size(), line.find('"', kStart.size()) - kStart.size());
}

SourceFile read_source(const fs::path& root, const fs::path& file) {
  SourceFile source{file.lexically_relative(root).generic_string(), {}, {}};
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) {
    if (const auto name = quoted_include(line))
      for (const fs::path& folder : {root / "src", file.parent_path()})
        if (const fs::path target = (folder / *name).lexically_normal(); fs::exists(target)) {
          source.includes.push_back(target.lexically_relative(root).generic_string());
          break;
        }
    source.lines.push_back(std::move(line));
  }
  return source;
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> sources;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (const fs::path extension = entry.path().extension(); extension == ".h" || extension == ".cpp")
        sources.push_back(read_source(root, entry.path()));
  std::sort(sources.begin(), sources.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return sources;
}

std::string unit_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

// Tarjan, "Depth-first search and linear graph algorithms", 1972.
std::vector<std::vector<std::string>> circles(const Arrows& arrows) {
  std::vector<std::vector<std::string>> found;
  std::map<std::string, std::size_t> number, lowest;
  std::vector<std::string> stack;
  std::set<std::string> on_stack;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    lowest[node] = number[node] = number.size();
    stack.push_back(node);
    on_stack.insert(node);
    if (const auto targets = arrows.find(node); targets != arrows.end())
      for (const std::string& target : targets->second) {
        if (!number.contains(target)) visit(target);
        if (on_stack.contains(target)) lowest[node] = std::min(lowest[node], lowest[target]);
      }
    if (lowest[node] != number[node]) return;
    const auto first = std::find(stack.begin(), stack.end(), node);
    std::vector<std::string> group(first, stack.end());
    stack.erase(first, stack.end());
    for (const std::string& member : group) on_stack.erase(member);
    std::sort(group.begin(), group.end());
    if (group.size() > 1) found.push_back(std::move(group));
  };
  for (const auto& [node, targets] : arrows)
    if (!number.contains(node)) visit(node);
  return found;
}

}  // namespace svnet
