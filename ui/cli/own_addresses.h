// Where others find a server that runs on this computer.
#pragma once

#include <string>
#include <vector>

#include "ui/cli/commands.h"

namespace bl::cli {

/// The addresses of a server with these options, as pages have them: `http://192.168.1.5:8080`. The first one is the one to tell.
std::vector<std::string> own_addresses(const ServeOptions& options, int port);

}  // namespace bl::cli
