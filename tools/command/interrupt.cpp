#include "command/interrupt.h"

#include <csignal>

namespace svnet::command {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interrupted = 0;

/// Without SA_RESTART, so that a call that waits for a pipe or a terminal returns.
void handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  ::sigaction(number, &action, nullptr);
}

void remember(int) {
  interrupted = 1;
  for (const int number : kSignals) handle(number, SIG_DFL);
}

}  // namespace

void remember_interrupts() {
  for (const int number : kSignals) {
    struct sigaction before {};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      handle(number, remember);  // nohup ignores SIGHUP; background jobs of scripts ignore SIGINT
  }
}

void throw_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace svnet::command
