// Says what came of plugins before anything is read that may need them.
#include "ui/cli/plugin_choice.h"

#include <utility>

#include "core/session/types/plugins.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

void load_chosen_plugins(std::vector<std::string> folders) {
  use_plugins(std::move(folders));
  for (const PluginReport& report : plugin_reports())
    if (report.error) complain(report.error->text());
}

}  // namespace bl::cli
