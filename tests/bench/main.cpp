// The program `behaviourlinks-bench`: reads its command line, measures, and prints the rows.
#include "tests/bench/bench_command.h"
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"
#include "ui/cli/program.h"

namespace bl::cli::bench {

namespace {

void declare(CLI::App& c, BenchOptions& o) {
  c.add_option("scenes", o.scenes, "Scenes to measure.")->type_name("SCENE");
  c.add_option("--sites", o.sites, "Random volumes in a box, half full; several numbers give several rows.")
      ->type_name("N")
      ->check(CLI::Range(1, 10000000));
  c.add_option("--threads", o.threads, "Threads; several numbers give several rows. Default: 1.")
      ->type_name("K")
      ->check(CLI::Range(1, 256));
  c.add_option("--repeat", o.repeat, "Number of measurements, of which the median is taken. Default: 3, for the solver 5.")
      ->type_name("R")
      ->check(CLI::Range(1, 1000));
  c.add_option("--ticks", o.ticks, "Ticks of one measurement. Default: 20.")->type_name("N")->check(CLI::Range(1, 1000000));
  c.add_option("--json", o.json, "Writes the rows as JSON, times in seconds.")->type_name("FILE");
  auto* times = c.add_flag("--times", o.is_times,
                           "Shows where the time of a tick goes: its parts, and kinds, nodes and links, the slowest first.");
  auto* solver = c.add_flag("--solver", o.is_solver,
                            "Measures the algorithms: cells, fits, drags, standing volumes, growth, rays, traffic, the feedback "
                            "on a scene, and ticks that "
                            "evaluate what has changed.")
                     ->excludes(times);
  c.add_flag("--quick", o.is_quick, "Of the solver: small sizes only, to see that all runs.")->needs(solver);
  c.add_option("--rows", o.rows, "Of the solver: these rows only.")
      ->type_name("ROWS")
      ->check(CLI::IsMember({"diagram", "wrapped", "fit", "drag", "standing", "growth", "complex", "rays", "traffic", "study",
                             "tick", "plan", "past", "load", "journal", "tick_growth"}))
      ->needs(solver);
  c.add_option("--seeds", o.seeds, "Of the solver: cold fits of so many random sets at each fill, the most steps of all.")
      ->type_name("K")
      ->check(CLI::Range(1, 1000000))
      ->needs(solver);
  c.add_option("--fill", o.fills, "Of the solver: ticks of volumes that fill so much of their boundary. Default: 70, 95 and 100.")
      ->type_name("PERCENT")
      ->check(CLI::Range(1.0, 100.0))
      ->needs(solver);
  c.add_option("--tntp", o.tntp, "Of the solver: networks for the rows of traffic, NAME_net.tntp with NAME_trips.tntp.")
      ->type_name("DIR")
      ->needs(solver);
  c.add_option("--chart", o.chart, "Of the solver: writes growth.svg, tick_growth.svg and feedback_newton.svg into a folder.")
      ->type_name("DIR")
      ->needs(solver);
  files_of(c).reads({"scenes", "--tntp"}).writes("--json", FileKind::figures).fills("--chart", {".svg"});
  c.footer(
      "Without scenes and --sites: 100 and 1000 random volumes; of the solver the sizes that suit each row, threads 1 and 2, "
      "and\n"
      "scenes/studies/sixty_volumes.json for the feedback.\n\nExample:\n  behaviourlinks-bench --sites 100 1000 --threads 1 2\n"
      "  behaviourlinks-bench --times scenes/studies/urban_mode.json\n"
      "  behaviourlinks-bench --solver --rows drag --sites 5000");
}

}  // namespace

}  // namespace bl::cli::bench

int main(int count, char** arguments) {
  return bl::cli::guarded([&] {
    CLI::App app{"Measures ticks per second and where the time goes, beside rivals in the same run.", "behaviourlinks-bench"};
    bl::cli::bench::BenchOptions options;
    bl::cli::bench::declare(app, options);
    if (const auto code = bl::cli::refusal(app, count, arguments)) return *code;
    return bl::cli::bench::bench_command(options);
  });
}
