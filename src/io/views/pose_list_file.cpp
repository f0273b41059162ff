#include "io/views/pose_list_file.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "io/views/csv_reader.h"

namespace svnet::io {
using view::CameraPose;

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const auto first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// A number with spaces around it, and perhaps a plus sign before it.
bool parse_field(std::string_view field, double& number) {
  std::string_view text = trimmed(field);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return parse_number(text, number);
}

}  // namespace

std::vector<CameraPose> read_pose_list(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  check(file && !std::filesystem::is_directory(path), path.string(), ": cannot be read; expected a CSV file of poses");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  check(!text.starts_with("\xff\xfe") && !text.starts_with("\xfe\xff"), path.string(),
        ": is text in UTF-16; save it as UTF-8");
  std::vector<CameraPose> poses;
  CsvReader reader(text, path.string());
  std::size_t columns = 0;  // of the header
  while (reader.next()) {
    const std::vector<std::string>& fields = reader.fields();
    const std::string at = joined(path.string(), ":", reader.line(), ": ");
    if (fields.size() == 1 && trimmed(fields[0]).empty()) continue;
    const std::string shown = printable(trimmed(reader.text()));
    if (columns == 0) {
      check(fields.size() >= 2 && trimmed(fields[0]) == "theta" && trimmed(fields[1]) == "phi", at, "the header is '",
            shown, "', expected 'theta,phi'");
      columns = fields.size();
      continue;
    }
    check(fields.size() == columns, at, "'", shown, "' has ", fields.size(), " columns, the header ", columns);
    CameraPose pose;
    check(parse_field(fields[0], pose.theta_deg) && parse_field(fields[1], pose.phi_deg), at, "'", shown,
          "' does not begin with two numbers, theta and phi in degrees");
    const std::string problem = pose_problem(pose);
    check(problem.empty(), at, problem);
    poses.push_back(clamped_pose(pose));
  }
  check(!file.bad(), path.string(), ": cannot be read to its end");
  check(!poses.empty(), path.string(), ": holds no pose; expected the header 'theta,phi' and a line for each pose");
  return poses;
}

}  // namespace svnet::io
