#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace svnet::io {

/// Comma-separated values as RFC 4180 defines them: fields may be in quotes, which then may hold commas, line breaks
/// and doubled quotes; lines end with CR LF, LF or CR. Also accepted: a byte order mark at the start, and spaces around
/// a quoted field.
class CsvReader {
 public:
  /// `name` begins the message of an Error. The text must outlive the reader.
  CsvReader(std::string_view text, std::string name);

  /// Reads the next record; false at the end. Throws Error that names the line for a quote that is not closed, and for
  /// text after a closing quote.
  bool next();
  const std::vector<std::string>& fields() const { return fields_; }
  /// The number of the record's first line, from 1.
  long line() const { return line_; }
  /// The record as it stands in the file.
  std::string_view text() const { return record_; }

 private:
  std::string quoted_field();
  std::string plain_field();
  /// Skips one line break; whether there was one.
  bool skip_line_break();
  void skip_spaces();

  std::string_view rest_, record_;
  std::string name_;
  std::vector<std::string> fields_;
  long line_ = 0, next_line_ = 1;
};

}  // namespace svnet::io
