#include "io/views/csv_reader.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::io {

CsvReader::CsvReader(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets begin UTF-8 with it
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool CsvReader::skip_line_break() {
  if (rest_.empty() || (rest_[0] != '\r' && rest_[0] != '\n')) return false;
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
  ++next_line_;
  return true;
}

void CsvReader::skip_spaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }

std::string CsvReader::quoted_field() {
  std::string field;
  rest_.remove_prefix(1);
  for (;;) {
    check(!rest_.empty(), name_, ":", line_, ": a quote is not closed");
    if (rest_.starts_with("\"\"")) {
      field += '"';
      rest_.remove_prefix(2);
    } else if (rest_[0] == '"') {
      rest_.remove_prefix(1);
      break;
    } else if (const std::string_view before = rest_; skip_line_break()) {
      field += before.substr(0, before.size() - rest_.size());
    } else {
      field += rest_[0];
      rest_.remove_prefix(1);
    }
  }
  skip_spaces();
  check(rest_.empty() || rest_[0] == ',' || rest_[0] == '\r' || rest_[0] == '\n', name_, ":", line_,
        ": text after a closing quote; double the quotes inside a field");
  return field;
}

std::string CsvReader::plain_field() {
  const std::string_view field = rest_.substr(0, rest_.find_first_of(",\r\n"));
  rest_.remove_prefix(field.size());
  return std::string(field);
}

bool CsvReader::next() {
  if (rest_.empty()) return false;
  const std::string_view start = rest_;
  line_ = next_line_;
  fields_.clear();
  for (;;) {
    const std::string_view field = rest_;
    skip_spaces();
    if (!rest_.empty() && rest_[0] == '"') {
      fields_.push_back(quoted_field());
    } else {
      rest_ = field;
      fields_.push_back(plain_field());
    }
    if (rest_.empty() || rest_[0] != ',') break;
    rest_.remove_prefix(1);
  }
  record_ = start.substr(0, start.size() - rest_.size());
  skip_line_break();
  return true;
}

}  // namespace svnet::io
