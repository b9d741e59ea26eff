// Ctrl-C as a flag that loops check between two ticks, so that a run ends with its results written.
#pragma once

namespace bl::cli {

/// From now on the first Ctrl-C (or SIGTERM) only sets a flag; a second one ends the program at once.
void catch_interrupts();
bool is_interrupted();
/// 130 after Ctrl-C, 143 after a kill: 128 and the number of the signal.
int interrupt_exit_code();

}  // namespace bl::cli
