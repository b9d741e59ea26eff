// Before a document is saved the canvas stores where its boxes lie.
#include "ui/desktop/panels/workbench.h"

#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {

Result<void> Workbench::save(const std::string& path) {
  if (canvas != nullptr) canvas->store_places();
  return document->save(path);
}

}  // namespace bl::desktop
