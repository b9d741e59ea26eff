// The commands of the program: the options of each, and the function that runs it and returns the exit code.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/making/context_import.h"
#include "core/making/media_making.h"
#include "core/making/scene_additions.h"
#include "core/making/scene_making.h"

namespace bl::cli {

/// Exit codes: success; bad input; the request cannot be met. The exit codes of interrupts are in interrupt.h.
inline constexpr int kDone = 0, kBadInput = 2, kNotMet = 3;

struct RunOptions {
  std::string scene;
  long long ticks = -1;        ///< -1: run until settled
  bool is_settling = false;    ///< given explicitly; it is the default where no ticks are given
  long long max_ticks = 2000;  ///< largest number of ticks of a run until settled
  int threads = 1;
  std::string log, report, json, save;
  std::vector<std::string> set, scripts;
  bool reads_anywhere = false;  ///< recordings may lie outside the folder of the scene
  bool is_live = false;         ///< connects to sensors and actuators, and ticks in real time until it is stopped
  double rate = 0;              ///< ticks per second of a live run; 0: as the sensors say
};
int run_command(const RunOptions& options);

struct ScriptOptions {
  std::string scene, out, extract;
  std::vector<std::string> files, removed;
  bool is_forced = false;
};
int script_command(const ScriptOptions& options);

struct CheckOptions {
  std::vector<std::string> scenes;
  std::string json;
  bool is_writing = false;
};
int check_command(const CheckOptions& options);

struct ReplayOptions {
  std::string log;
  int threads = 1;
};
int replay_command(const ReplayOptions& options);

struct EraseOptions {
  std::string session;
  long long seat = 0;
};
int erase_command(const EraseOptions& options);

struct MinutesOptions {
  std::string session, out, zone = "UTC";
};
int minutes_command(const MinutesOptions& options);

struct ServeOptions {
  std::vector<std::string> sources;  ///< scenes and session files
  int port = 8080;
  std::string bind = "0.0.0.0", journal, invites, page, certificate, key, name, proxy;
  bool is_live = false, scripts = false;
  std::string follow, token, trust;  ///< of a second laptop: the room of the first, its key, and whose certificates are believed
  bool is_safe = false;
  double take_over = 0;      ///< [s]; 0: only when somebody says so
  bool is_checking = false;  ///< says whether all is ready, and opens nothing
  std::string json;          ///< of the check
};
int serve_command(ServeOptions options);
/// `serve --check`: measures what a session needs, one line for each finding.
int check_before_serving(const ServeOptions& options);
/// Where the session of a scene is kept: in the folder or file that was named, or in the present folder under the scene's name.
std::string journal_of(const ServeOptions& options, const std::string& source);
/// Follows a room until it is to be taken over: then there is no exit code, and the options name the copy as what to serve.
std::optional<int> follow_room(ServeOptions& options);

struct RehearseOptions {
  std::string room, trust;
  int bots = 20;
  double seconds = 60;
  long long seed = 1;
  bool shows_progress = false;
};
int rehearse_command(const RehearseOptions& options);

struct CompareOptions {
  std::string first, second;
  long long ticks = -1;        ///< -1: until settled
  long long max_ticks = 2000;  ///< largest number of ticks of a run until settled
  int threads = 1;
  std::string report;
};
int compare_command(const CompareOptions& options);

int new_command(const making::NewOptions& options);

int import_command(const making::ImportOptions& options);

struct AddOptions {
  std::string scene, what, out;  ///< `what`: one of `kAdditions`; `out`: empty for the scene itself
  bool is_forced = false;
  making::RuleAddition rules;
  making::SunAddition sun;
  making::GardenAddition garden;
};
int add_command(const AddOptions& options);
struct PlaceOptions {
  std::vector<std::string> files;
  std::string into, out;
  std::vector<double> at;  ///< nothing, or x, y, z [m]
  making::MediaOptions media;
  bool is_forced = false;
};
int place_command(const PlaceOptions& options);

struct ExportOptions {
  std::string scene;
  std::vector<std::string> formats, outs;  ///< pairs in the order given
  std::vector<std::string> options;        ///< each NAME=VALUE
  bool is_settling = false;                ///< first runs until the scene settles
  long long max_ticks = 2000;
  int threads = 1;
};
int export_command(const ExportOptions& options);

struct OpenOptions {
  std::vector<std::string> arguments;  ///< the arguments of the window's own program
};
/// Returns only where that program could not be started.
int open_command(const OpenOptions& options);

struct DocsOptions {
  std::string type, out, from;
  bool is_list = false;
};
int docs_command(const DocsOptions& options);

struct SchemaOptions {
  std::string out;
  bool is_of_messages = false, is_types = false;
};
int schema_command(const SchemaOptions& options);

struct CellsOptions {
  std::string input, json, boundary;
  int threads = 1;
  bool with_complex = false;
};
int cells_command(const CellsOptions& options);

struct FitFileOptions {
  std::string input, json, boundary;
  std::string method = "newton";  ///< or "feedback"
  double tolerance = 1e-6;        ///< largest relative error
  int threads = 1;
  int steps = 200;  ///< at most so many evaluations of the diagram
};
int fit_command(const FitFileOptions& options);

struct AssignOptions {
  std::string net, trips, flows, nodes, json;
  double gap = 1e-6;
  int iterations = 1000;                          ///< at most
  double toll_factor = -1, distance_factor = -1;  ///< below 0: what the file says, or 0
  std::vector<std::string> edit_capacity, close;  ///< LINK=VALUE, LINK: applied to the equilibrium found
  std::vector<std::string> routes, reach;         ///< FROM-TO, NODE=LIMIT: reported for the last equilibrium
  int repeat = 1;                                 ///< how often to measure; the median times are reported
};
int assign_command(const AssignOptions& options);

}  // namespace bl::cli
