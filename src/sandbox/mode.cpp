#include "sandbox/mode.h"

#include <atomic>

namespace svnet::sandbox {
namespace {

std::atomic<Mode>& chosen() {
  static std::atomic<Mode> mode{Mode::on};
  return mode;
}

}  // namespace

void set_mode(Mode mode) { chosen() = mode; }
Mode mode() { return chosen(); }

}  // namespace svnet::sandbox
