// What is wrong with a command line, in sentences that say what to do.
#pragma once

#include <string>

#include "ui/cli/declarations.h"

namespace bl::cli {

/// `task`: the one that the line is for, or the program itself.
std::string usage_sentence(const CLI::App& task, const CLI::ParseError& error);

}  // namespace bl::cli
