#include "io/pose_list_file.h"

#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "printable.h"

namespace svnet {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets begin UTF-8 with it

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Whether all of `text` is a number.
bool parse(std::string_view text, double& number) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

}  // namespace

std::vector<Pose> read_pose_list(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  check(file && !std::filesystem::is_directory(path), path.string(), ": cannot be read; expected a CSV file of poses");
  std::vector<Pose> poses;
  bool header_seen = false;
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    std::string_view text = line;
    if (number == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    text = trimmed(text);
    if (text.empty()) continue;
    const auto comma = text.find(',');
    const std::string_view first = trimmed(text.substr(0, comma)),
                           second = comma == std::string_view::npos ? "" : trimmed(text.substr(comma + 1));
    if (!header_seen) {
      check(first == "theta" && second == "phi", path.string(), ":", number, ": the header is '", printable(text),
            "', expected 'theta,phi'");
      header_seen = true;
      continue;
    }
    Pose pose;
    check(parse(first, pose.theta_deg) && parse(second, pose.phi_deg), path.string(), ":", number, ": '",
          printable(text), "' is not two numbers, theta and phi in degrees, with a comma between them");
    const std::string problem = pose_problem(pose);
    check(problem.empty(), path.string(), ":", number, ": ", problem);
    poses.push_back(pose);
  }
  check(!file.bad(), path.string(), ": cannot be read to its end");
  check(!poses.empty(), path.string(), ": holds no pose; expected the header 'theta,phi' and a line for each pose");
  return poses;
}

}  // namespace svnet
