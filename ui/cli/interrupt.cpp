// The handler of the two signals that ask a program to end.
#include "ui/cli/interrupt.h"

#include <csignal>

namespace bl::cli {

namespace {

volatile std::sig_atomic_t received_signal = 0;

void remember(int number) { received_signal = number; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  // Once only: whoever presses Ctrl-C again does not want to wait. Reads and writes go on where they were.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() { return received_signal != 0; }

int interrupt_exit_code() { return 128 + static_cast<int>(received_signal); }

}  // namespace bl::cli
