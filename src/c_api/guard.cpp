#include "guard.h"

#include "base/text.h"

namespace svnet {
namespace {

/// A fixed buffer, so that storing a message cannot run out of memory.
thread_local char last_error[1024] = "";

}  // namespace

svnet_status failed(svnet_status status, const char* text) noexcept {
  std::size_t length = 0;
  for (; length + 1 < sizeof last_error && text[length] != '\0'; ++length) last_error[length] = printable(text[length]);
  last_error[length] = '\0';
  return status;
}

const char* last_failure() noexcept { return last_error; }

}  // namespace svnet
