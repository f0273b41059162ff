#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace svnet::serve {

/// A part of a multipart/form-data body (RFC 7578).
struct FormPart {
  std::string name;
  std::string_view contents;  // within the body
};

/// Whether a Content-Type is multipart/form-data.
bool is_form_data(std::string_view content_type);

/// The parts of a body, at most 32. Throws Refusal 400 unless it is whole: every part has a name, and the last boundary
/// is there.
std::vector<FormPart> form_parts(std::string_view body, const std::string& content_type);

}  // namespace svnet::serve
