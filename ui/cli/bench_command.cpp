// `bench`: stub.
#include "ui/cli/commands.h"
namespace bl::cli { int bench_command(const BenchOptions&) { return 2; } }
