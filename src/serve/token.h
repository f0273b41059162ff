#pragma once
#include <filesystem>
#include <string>

namespace svnet::serve {

/// The only line of a file: 16 to 512 of the characters A-Z a-z 0-9 - . _ ~ + / = (RFC 6750). Throws Error that names
/// the file for any other contents, and does not repeat them.
std::string read_token(const std::filesystem::path& file);

/// Whether the texts are equal. The time depends on neither where they differ nor the length of `secret`.
bool equal_in_constant_time(const std::string& given, const std::string& secret);

}  // namespace svnet::serve
