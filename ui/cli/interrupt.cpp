// The handler of the two signals that ask a program to end.
#include "ui/cli/interrupt.h"

#include <unistd.h>
#include <atomic>
#include <csignal>
#include <ctime>

namespace bl::cli {

namespace {

// Launchers tend to send a signal to a program and to its group, so that it arrives twice at once; nobody presses that fast.
constexpr double kSameRequest = 0.3;  // [s]

// Asked by the threads of a pool, too, which a variable that is only volatile is not made for; without a lock, so that a handler
// may touch it.
std::atomic<int> received_signal{0};
std::atomic<double> received_at{0};  // [s]
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

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

int interrupt_exit_code() { return 128 + received_signal; }

}  // namespace bl::cli
