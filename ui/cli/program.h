// Shared by the main functions of the command line programs: parsing with its error messages, and exit codes.
#pragma once

#include <functional>
#include <optional>

#include <CLI/CLI.hpp>

namespace bl::cli {

/// The exit code of `work`. An exception becomes a sentence on standard error and exit code 1; output that could not be written,
/// such as onto a full disk, gives kBadInput.
int guarded(const std::function<int()>& work);

/// Parses the command line into the variables declared on `app`. Returns nothing where the run may go on; else the exit code,
/// after printing help or an error message.
std::optional<int> refusal(CLI::App& app, int count, char** arguments);

}  // namespace bl::cli
