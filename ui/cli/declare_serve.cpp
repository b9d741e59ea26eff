// Declares `serve` with its options: where it listens, what it stores, and what it lets people do; and `rehearse`.
#include "ui/cli/declarations.h"
#include "ui/cli/file_rule.h"

namespace bl::cli {

namespace {

void declare_follow(CLI::App& c, CLI::Option& sources, ServeOptions& o) {
  auto* follow =
      c.add_option("--follow", o.follow,
                   "Serves nothing yet, but keeps a copy of the room at this address (room://HOST:PORT/CODE) in the file of "
                   "--journal, and takes the room over when it is told to.")
          ->type_name("URL")
          ->excludes(&sources);
  c.add_option("--token", o.token, "With --follow: the key that the first laptop has printed, or a facilitator's token.")
      ->type_name("KEY")
      ->needs(follow);
  c.add_option("--trust", o.trust, "With --follow: whose certificates are believed, as PEM. Default: the system's authorities.")
      ->type_name("FILE")
      ->needs(follow);
  c.add_flag("--safe", o.is_safe, "With --follow: people get an answer only once this laptop has stored it, too.")->needs(follow);
  c.add_option("--take-over", o.take_over,
               "With --follow: takes the room over by itself when the first laptop has been gone for so many seconds.")
      ->type_name("SECONDS")
      ->check(CLI::Range(5.0, 3600.0))
      ->needs(follow);
}

void declare_check(CLI::App& c, ServeOptions& o) {
  auto* check = c.add_flag("--check", o.is_checking,
                           "Opens no room, but says whether all is ready for one: disk, power, network, clock, scene. "
                           "Each line says good, look or bad, the figure, and what to do.")
                    ->excludes("--follow");
  c.add_option("--json", o.json, "With --check: writes the findings as JSON, too.")->type_name("FILE")->needs(check);
}

}  // namespace

void declare_serve(CLI::App& app, ServeOptions& o) {
  CLI::App& c =
      *app.add_subcommand("serve", "Opens a room for a scene: people join by a code, and everything they say is stored.");
  auto* sources =
      c.add_option("sources", o.sources, "Scene files, each for a room of its own; or session files, which are continued.")
          ->type_name("SCENE|FILE.blsession");
  c.add_option("--port", o.port, "The port for pages and connections; 0 for any free one. Default: 8080.")
      ->type_name("N")
      ->check(CLI::Range(0, 65535));
  c.add_option("--bind", o.bind, "The address of this computer to listen on. Default: all of them.")->type_name("ADDRESS");
  c.add_option(
       "--journal", o.journal,
       "The session file, or the folder for it. A file that is there is continued. Default: NAME.blsession in the present "
       "folder, after the scene.")
      ->type_name("FILE|DIR");
  c.add_option("--invites", o.invites,
               "Writes the keys of all roles as JSON: {\"CODE\": {\"facilitator\": \"...\", ...}}. "
               "They are written again when the facilitator renews the keys.")
      ->type_name("FILE");
  c.add_option(
       "--page", o.page,
       "Folder of the built page. Default: the variable BEHAVIOURLINKS_PAGE; without either, pages without scripts are shown.")
      ->type_name("DIR");
  auto* certificate = c.add_option("--certificate", o.certificate, "Certificate chain for TLS, as PEM.")->type_name("FILE");
  auto* key = c.add_option("--key", o.key, "Its private key, as PEM.")->type_name("FILE")->needs(certificate);
  certificate->needs(key);
  c.add_option(
       "--name", o.name,
       "The host name by which people find this computer, such as that of its certificate. Addresses that are told have it. "
       "Default: the addresses of this computer.")
      ->type_name("HOST");
  c.add_flag("--live", o.is_live,
             "Connects sensors and actuators, and lets facilitators set their addresses and names of files.");
  c.add_flag("--scripts", o.scripts, "Lets facilitators and designers write link kinds in Lua.");
  c.add_option("--behind-proxy", o.proxy,
               "The address of a proxy in front of the server. What it says in X-Forwarded-For, -Host and -Proto is believed.")
      ->type_name("ADDRESS");
  declare_follow(c, *sources, o);
  declare_check(c, o);
  files_of(c)
      .reads({"sources", "--journal", "--page", "--certificate", "--key", "--trust"})
      .writes("--invites", FileKind::figures)
      .writes("--json", FileKind::figures);
  c.footer(
      "One line for each room says its code and its address; another one the address of the facilitator. Whoever opens the "
      "first\n"
      "address takes part under the name of an animal. What is acknowledged is on the disk. Ctrl-C closes the rooms in order.\n"
      "GET /health says how the rooms are.\n\n"
      "What a second laptop needs to follow is printed, too. When the first is gone, the second takes over at Enter, at SIGUSR1, "
      "or\n"
      "after --take-over seconds; then it serves the room as the first did.\n\n"
      "Example:\n  behaviourlinks serve scenes/start/quarter.json --port 8080\n"
      "  behaviourlinks serve --follow room://192.168.1.5:8080/BKRT --token KEY --journal copy.blsession\n"
      "  behaviourlinks serve scenes/start/quarter.json --check\n\n"
      "Exit codes: 0 closed in order, or with --check nothing is bad; 2 bad input, or the port or the file is in use; 3 with "
      "--check\n"
      "something is bad.");
}

void declare_rehearse(CLI::App& app, RehearseOptions& o) {
  CLI::App& c =
      *app.add_subcommand("rehearse", "Fills a room with bots that act as people do, and says how fast the room answers them.");
  c.add_option("room", o.room, "The address of the room: room://HOST[:PORT]/CODE, or that of its page. Bots come by the code.")
      ->type_name("URL")
      ->required();
  c.add_option("--bots", o.bots, "How many bots take part. Default: 20.")->type_name("N")->check(CLI::Range(1, 199));
  c.add_option("--seconds", o.seconds, "How long they take part. Default: 60.")->type_name("S")->check(CLI::Range(1.0, 86400.0));
  c.add_option("--seed", o.seed, "Another number gives other bots. Default: 1.")->type_name("K");
  c.add_option("--trust", o.trust, "Whose certificates are believed, as PEM. Default: the system's authorities.")
      ->type_name("FILE");
  c.add_flag("--progress", o.shows_progress, "Says each second how far it is.");
  files_of(c).reads({"--trust"});
  c.footer(
      "Bots comment, vote, move the controls of their role cards, and propose. What they say stays in the room, so rehearse in "
      "a\n"
      "room that is thrown away: serve a copy of the scene with another --journal. With the facilitator's key in the address\n"
      "(#k=KEY), one more bot begins a phase, deals out the role cards of the scene, and opens its votes. With the key of "
      "another\n"
      "role, the bots come in by that key.\n\n"
      "Example:\n  behaviourlinks rehearse room://192.168.1.5:8080/BKRT#k=KEY --bots 30 --seconds 120\n\n"
      "At the end each line says good, look or bad: whether all bots came in, how long answers took, whether something was lost "
      "or\n"
      "stored twice, and how long comments and proposals took to be on all screens.\n\n"
      "Exit codes: 0 nothing is bad; 2 bad input; 3 something is bad; 130 stopped by Ctrl-C.");
}

}  // namespace bl::cli
