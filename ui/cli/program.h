// What the main functions of the command line programs share: the command line with its complaints, and what ends a run.
#pragma once

#include <functional>
#include <optional>

#include <CLI/CLI.hpp>

namespace bl::cli {

/// The exit code of `work`. Whatever it throws becomes a sentence on standard error and exit code 1; output that could not be
/// written, such as onto a full disk, becomes kBadInput.
int guarded(const std::function<int()>& work);

/// Reads the command line into what was declared on `app`. Nothing where the run may go on; else the exit code, after help was
/// printed or a sentence said what is wrong and what to do.
std::optional<int> refusal(CLI::App& app, int count, char** arguments);

}  // namespace bl::cli
