// `add`: puts building rules, a sun or a garden into a scene.
#include "core/file/file_io.h"
#include "core/session/ledger.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

int add_command(const AddOptions& options) {
  if (!options.out.empty() && !may_write(options.out, options.scene, options.is_forced)) return kBadInput;
  const auto reading = load_scene(options.scene);
  if (!reading) return kBadInput;
  const Registry& registry = full_registry();
  making::GardenAddition garden = options.garden;
  garden.sun = options.sun;
  const auto made = options.what == "rules" ? add_rules(reading->scene, registry, options.rules)
                    : options.what == "sun" ? add_sun(reading->scene, registry, options.sun)
                                            : add_garden(reading->scene, registry, garden);
  if (!made) {
    print_error(options.scene, made.error());
    return kBadInput;
  }
  Ledger ledger(registry, reading->scene);
  if (auto added = ledger.submit(made->command, "add", 0); !added) {
    print_error(options.scene, added.error());
    return kBadInput;
  }
  for (const std::string& sentence : made->said) print_line(sentence);
  const std::string& out = options.out.empty() ? options.scene : options.out;
  print_problems(out, check_scene(ledger.scene(), registry));
  // A state of before knows nothing of what is new: the scene begins again.
  if (auto written = write_file(out, write_scene(ledger.scene(), registry)); !written) {
    print_error(out, written.error());
    return kBadInput;
  }
  print_line("wrote " + out + ": " + counted(ledger.scene().nodes.size(), "node") + ", " +
             counted(ledger.scene().links.size(), "link"));
  return kDone;
}

}  // namespace bl::cli
