// The handler of the two signals that ask a program to end.
#include "ui/cli/interrupt.h"

#include <unistd.h>
#include <csignal>
#include <ctime>

namespace bl::cli {

namespace {

// Launchers tend to send a signal to a program and to its group, so that it arrives twice at once; nobody presses that fast.
constexpr double kSameRequest = 0.3;  // [s]

volatile std::sig_atomic_t received_signal = 0;
double received_at = 0;  // read and written by the handler alone

void remember(int number) {
  struct timespec time {};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  const double seconds = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  if (received_signal != 0 && seconds - received_at > kSameRequest) ::_exit(128 + number);
  if (received_signal == 0) received_at = seconds;
  received_signal = number;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  // One signal must not interrupt the handling of the other.
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() { return received_signal != 0; }

int interrupt_exit_code() { return 128 + static_cast<int>(received_signal); }

}  // namespace bl::cli
