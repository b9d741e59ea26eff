// Where others find a server that runs on this computer.
#pragma once

#include <string>
#include <vector>

#include "ui/cli/commands.h"

namespace bl::cli {

/// The address of a server with these options at one host, as pages have it: `http://192.168.1.5:8080`.
std::string url_of(const ServeOptions& options, const std::string& host, int port);
/// By which names or addresses people find a server with these options: its name, or else the addresses of this computer.
std::vector<std::string> own_hosts(const ServeOptions& options);
/// The addresses of a server with these options, as pages have them: `http://192.168.1.5:8080`. The first one is the one to tell.
std::vector<std::string> own_addresses(const ServeOptions& options, int port);

}  // namespace bl::cli
