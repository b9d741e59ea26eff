// The registry of all types, made when it is first asked for.
#include "core/define/registry.h"

namespace bl {

const Registry& full_registry() {
  static const Registry kRegistry = [] {
    Registry registry;
    register_base_node(registry);
    register_typifications(registry);
    register_links(registry);
    register_commands(registry);
    return registry;
  }();
  return kRegistry;
}

}  // namespace bl
