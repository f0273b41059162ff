#include "serve/form_data.h"

#include <algorithm>

#include "base/text.h"
#include "serve/refusal.h"

namespace svnet::serve {
namespace {

constexpr std::size_t kMostParts = 32, kLongestHead = 4096;
constexpr std::string_view kLineEnd = "\r\n";

/// The text up to a semicolon that is not in quotes, which is removed from `rest` with it.
std::string_view next_item(std::string_view& rest) {
  bool quoted = false;
  std::size_t end = 0;
  for (; end < rest.size() && (quoted || rest[end] != ';'); ++end)
    if (rest[end] == '"') quoted = !quoted;
  const std::string_view item = rest.substr(0, end);
  rest.remove_prefix(std::min(rest.size(), end + 1));
  return item;
}

/// The value of a parameter such as name="image", with or without quotes; empty if it is missing.
std::string parameter_value(std::string_view header, std::string_view parameter) {
  while (!header.empty()) {
    std::string_view item = next_item(header);
    item.remove_prefix(std::min(item.find_first_not_of(" \t"), item.size()));
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || lower_case(item.substr(0, equals)) != parameter) continue;
    item.remove_prefix(equals + 1);
    if (item.starts_with('"')) return std::string(item.substr(1, item.find('"', 1) - 1));
    return std::string(item.substr(0, item.find_first_of(" \t")));
  }
  return "";
}

/// The name that a part's headers give it.
std::string part_name(std::string_view headers) {
  while (!headers.empty()) {
    const std::string_view line = headers.substr(0, headers.find(kLineEnd));
    if (lower_case(line).starts_with("content-disposition:")) return parameter_value(line, "name");
    headers.remove_prefix(std::min(headers.size(), line.size() + kLineEnd.size()));
  }
  return "";
}

}  // namespace

bool is_form_data(std::string_view content_type) { return lower_case(content_type).starts_with("multipart/form-data"); }

std::vector<FormPart> form_parts(std::string_view body, const std::string& content_type) {
  const std::string boundary = parameter_value(content_type, "boundary");
  expect(!boundary.empty() && boundary.size() <= 70, 400, "multipart/form-data needs a boundary of 1 to 70 characters");
  const std::string first = "--" + boundary, between = joined(kLineEnd, first);
  expect(body.starts_with(first), 400, "the form does not begin with its boundary");
  body.remove_prefix(first.size());
  std::vector<FormPart> parts;
  while (!body.starts_with("--")) {
    expect(body.starts_with(kLineEnd), 400, "the form is damaged: a boundary is not the end of its line");
    expect(parts.size() < kMostParts, 400, "the form has more than ", kMostParts, " parts");
    body.remove_prefix(kLineEnd.size());
    const std::size_t head = body.find("\r\n\r\n"), end = body.find(between);
    expect(head != std::string_view::npos && end != std::string_view::npos, 400, "the form ends within a part");
    expect(head + 4 <= end, 400, "the form is damaged: a part has no headers");
    expect(head <= kLongestHead, 400, "the form is damaged: the headers of a part are longer than ", kLongestHead);
    const std::string name = part_name(body.substr(0, head));
    expect(!name.empty(), 400, "a part of the form has no name");
    parts.push_back({name, body.substr(head + 4, end - head - 4)});
    body.remove_prefix(end + between.size());
  }
  return parts;
}

}  // namespace svnet::serve
