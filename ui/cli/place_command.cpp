// `place`: adds pictures to a scene, with the metadata of their files.
#include "core/file/file_io.h"
#include "core/session/ledger.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

int place_command(const PlaceOptions& options) {
  if (!options.out.empty() && !may_write(options.out, options.into, options.is_forced)) return kBadInput;
  const auto reading = load_scene(options.into);
  if (!reading) return kBadInput;
  making::MediaOptions media = options.media;
  media.scene = options.out.empty() ? options.into : options.out;
  if (options.at.size() == 3) media.position = Vector3{options.at[0], options.at[1], options.at[2]};
  Ledger ledger(full_registry(), reading->scene);
  bool is_all_well = true;
  for (const std::string& file : options.files) {
    const auto made = making::make_media(file, ledger.scene(), media);
    const auto added = made ? ledger.submit(made->command, "place", 0) : Result<void>(made.error());
    if (!added) {
      print_error(file, added.error());
      is_all_well = false;
      continue;
    }
    for (const std::string& note : made->notes) print_line("note: " + file + ": " + note);
    print_line("placed " + file + " as `" + made->id + "`");
  }
  // All or none: half of what was asked for is easily taken for the whole.
  if (!is_all_well) return kBadInput;
  const SavedState* state = reading->state ? &*reading->state : nullptr;
  if (auto written = write_file(media.scene, write_scene(ledger.scene(), full_registry(), state)); !written) {
    print_error(media.scene, written.error());
    return kBadInput;
  }
  print_line("wrote " + media.scene + ": " + counted(ledger.scene().nodes.size(), "node") + " in all");
  return kDone;
}

}  // namespace bl::cli
