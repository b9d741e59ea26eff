// Ends the program with a sentence, not an abort, when the system has no more memory or threads for it.
#pragma once

#include <string>
#include <string_view>

namespace bl {

/// Lays some memory aside, which is set free when no more is to be had, so that what was half made can be taken down; and ends
/// the program with the sentence where even that does not help, or where nobody catches what was thrown: without taking anything
/// down, so that what is kept against crashes is kept. Call it once, at the start. `comfort` is what is said besides; it outlives
/// the program.
void prepare_for_scarcity(std::string_view comfort = {});

std::string memory_sentence();
std::string thread_sentence();

}  // namespace bl
