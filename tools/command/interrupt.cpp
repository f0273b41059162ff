#include "command/interrupt.h"

#include <csignal>

namespace svnet {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void remember_interrupts() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

void throw_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace svnet
