// Errors of a command line as sentences that say what to do.
#pragma once

#include <string>

#include "ui/cli/declarations.h"

namespace bl::cli {

/// `task`: the command that was called, or the program itself.
std::string usage_sentence(const CLI::App& task, const CLI::ParseError& error);

}  // namespace bl::cli
