// What the program says when the system has no more memory or no more threads for it: a sentence, never an abort.
#pragma once

#include <string>

namespace bl::cli {

/// Lays some memory aside, which is set free when no more is to be had, so that what was half made can be taken down; and ends
/// the program with the sentence where even that does not help. Call it once, at the start.
void prepare_for_scarcity();

std::string memory_sentence();
std::string thread_sentence();

}  // namespace bl::cli
