#pragma once
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/text.h"

namespace svnet {

/// An error that a user can cause and fix. Its text is one line: what was wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// There is not enough memory. Interfaces catch it as std::bad_alloc. Its text says how much was needed.
class NoMemory : public std::bad_alloc {
 public:
  explicit NoMemory(std::size_t bytes) : text_("no memory for " + std::to_string(bytes >> 20) + " MiB") {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// The parts, written one after the other.
template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// Throws Error with the joined parts. They may be text of a file: what would break the line, or change what a terminal
/// shows, is replaced (`printable`).
template <class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  throw Error(printable(joined(parts...)));
}

/// Throws Error with the joined parts unless `condition` holds.
template <class... Parts>
void check(bool condition, const Parts&... parts) {
  if (!condition) fail(parts...);
}

}  // namespace svnet
