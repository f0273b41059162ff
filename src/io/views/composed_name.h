#pragma once
#include <string>
#include <string_view>

namespace svnet::io {

/// The text in Unicode's composed form (NFC). macOS stores names of files decomposed (NFD), people type them composed:
/// both are the same name. Text that is not UTF-8 comes back as it is.
std::string composed_name(std::string_view name);

}  // namespace svnet::io
