#include "io/views/pose_list_file.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace svnet {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets begin UTF-8 with it

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Column `index` of a line of comma-separated values; empty if there are fewer columns.
std::string_view column(std::string_view line, int index) {
  for (; index > 0; --index) line.remove_prefix(std::min(line.find(','), line.size() - 1) + 1);
  return trimmed(line.substr(0, line.find(',')));
}

}  // namespace

std::vector<CameraPose> read_pose_list(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  check(file && !std::filesystem::is_directory(path), path.string(), ": cannot be read; expected a CSV file of poses");
  std::vector<CameraPose> poses;
  std::ptrdiff_t commas = -1;  // of the header
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    std::string_view text = line;
    if (number == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    text = trimmed(text);
    if (text.empty()) continue;
    const std::string_view first = column(text, 0), second = column(text, 1);
    const auto commas_here = std::count(text.begin(), text.end(), ',');
    if (commas < 0) {
      check(first == "theta" && second == "phi", path.string(), ":", number, ": the header is '", printable(text),
            "', expected 'theta,phi'");
      commas = commas_here;
      continue;
    }
    check(commas_here == commas, path.string(), ":", number, ": '", printable(text), "' has ", commas_here + 1,
          " columns, the header ", commas + 1);
    CameraPose pose;
    check(parse_number(first, pose.theta_deg) && parse_number(second, pose.phi_deg), path.string(), ":", number, ": '",
          printable(text), "' does not begin with two numbers, theta and phi in degrees");
    const std::string problem = pose_problem(pose);
    check(problem.empty(), path.string(), ":", number, ": ", problem);
    poses.push_back(clamped_pose(pose));
  }
  check(!file.bad(), path.string(), ": cannot be read to its end");
  check(!poses.empty(), path.string(), ": holds no pose; expected the header 'theta,phi' and a line for each pose");
  return poses;
}

}  // namespace svnet
