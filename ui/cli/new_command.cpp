// `new`: stub.
#include "ui/cli/commands.h"
namespace bl::cli { int new_command(const NewOptions&) { return 2; } }
