// Declares the command line to the library that parses it; `main.cpp` runs the commands.
#pragma once

#include <CLI/CLI.hpp>

#include "ui/cli/commands.h"

namespace bl::cli {

/// --threads, for all commands that compute.
void add_threads(CLI::App& command, int& threads);

void declare_new(CLI::App& app, making::NewOptions& o);
void declare_import(CLI::App& app, making::ImportOptions& o);
void declare_add(CLI::App& app, AddOptions& o);
void declare_place(CLI::App& app, PlaceOptions& o);
void declare_script(CLI::App& app, ScriptOptions& o);

void declare_export(CLI::App& app, ExportOptions& o);

void declare_serve(CLI::App& app, ServeOptions& o);
void declare_rehearse(CLI::App& app, RehearseOptions& o);

void declare_cells(CLI::App& app, CellsOptions& o);
void declare_fit(CLI::App& app, FitFileOptions& o);
void declare_assign(CLI::App& app, AssignOptions& o);

}  // namespace bl::cli
