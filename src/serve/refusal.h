#pragma once
#include <string>

#include "base/error.h"

namespace svnet::serve {

/// An Error with the HTTP status that answers it. Thrown through refuse and expect.
class Refusal : public Error {
 public:
  Refusal(int status, const std::string& message) : Error(message), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

template <class... Parts>
[[noreturn]] void refuse(int status, const Parts&... parts) {
  throw Refusal(status, printable(joined(parts...)));
}

/// Throws Refusal with the status and the joined parts unless `condition` holds.
template <class... Parts>
void expect(bool condition, int status, const Parts&... parts) {
  if (!condition) refuse(status, parts...);
}

}  // namespace svnet::serve
