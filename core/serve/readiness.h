// Is this computer ready for a session? Each figure gets a verdict, and a sentence that says what to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/serve/certificate.h"
#include "core/serve/machine.h"
#include "core/serve/measuring.h"

namespace bl::serve {

/// A traffic light in words: nothing to do; have a look at it; the session will suffer from it.
enum class Verdict : std::uint8_t { good, look, bad };
/// `good`, `look`, `bad`.
const char* word_of(Verdict verdict);

struct Finding {
  Verdict verdict = Verdict::good;
  std::string subject;  ///< one word, such as `disk`
  std::string text;     ///< the figure, and what to do where it is not good
  bool operator==(const Finding&) const = default;
};
/// `good  disk      A commit takes ...`: one line, as scripts and the window read it. A text of several lines becomes one.
std::string line_of(const Finding& finding);
/// The finding of such a line; nothing where it is none.
std::optional<Finding> finding_of_line(const std::string& line);

Finding judge_commits(const Durations& times);
Finding judge_free_disk(std::optional<std::int64_t> bytes);
Finding judge_power(const Machine& machine);
Finding judge_memory(std::optional<std::int64_t> bytes);
Finding judge_clock(std::optional<bool> is_set);
/// `rate`: the ticks in a second that a room wants.
Finding judge_ticks(const Durations& times, double rate);
/// Of a room that runs: how long a tick takes there [s], and how many a second it wants.
Finding judge_pace(double tick_seconds, double rate, bool is_paused);
/// Of a room that runs: how long storing takes mostly, and in the slow cases [s].
Finding judge_storing(double median, double slow);
/// `quality`: 0 to 1.
Finding judge_wireless(const std::string& interface, double quality);
/// How many other devices have come by an address of an open room.
Finding judge_reach(const std::string& url, std::size_t count);
/// An address of a server. `reached`: how many other devices have come by it; missing where no room is open.
Finding judge_address(const NetworkAddress& address, const std::string& url, const Machine& machine,
                      std::optional<std::size_t> reached);
/// What has come of bots that took part in a room.
struct Rehearsed {
  std::size_t bots = 0, came = 0;  ///< how many there are, and how many came in
  std::string why_absent = {};     ///< the last reason, where some did not come
  int lost_connections = 0;
  std::int64_t said = 0, refused = 0, unanswered = 0;  ///< operations
  std::int64_t doubled = 0;                            ///< those that were stored more than once
  std::int64_t told = 0, lost = 0;                     ///< stored comments and proposals, and those that some screen lacks
  std::optional<double> answers = {}, screens = {};    ///< 95 of 100 were answered, and were on all screens, within [s]
};
/// A line each for `people`, `answers`, `stored` and `screens`.
std::vector<Finding> judge_rehearsal(const Rehearsed& figures);
/// What encrypts a server. `hosts`: the names and addresses by which people come, as they were asked about when it was read;
/// empty where they are not known, as behind a proxy. `now`: [ms since 1970].
Finding judge_certificate(const Result<Certificate>& certificate, const std::vector<std::string>& hosts, std::int64_t now);

}  // namespace bl::serve
