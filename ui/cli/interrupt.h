// Ctrl-C as a question that loops ask between two ticks, so that a run ends with what is there.
#pragma once

namespace bl::cli {

/// From now on the first Ctrl-C (or a polite kill) only sets a mark; a second one ends the program at once.
void catch_interrupts();
bool is_interrupted();
/// 130 after Ctrl-C, 143 after a kill: 128 and the number of the signal.
int interrupt_exit_code();

}  // namespace bl::cli
