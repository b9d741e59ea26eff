// The limits, with their reasons; and the sentences.
#include "core/serve/readiness.h"

#include <algorithm>
#include <array>

#include "core/base/moment.h"
#include "core/base/text.h"
#include "core/reading/figures.h"

namespace bl::serve {

namespace {

constexpr std::array<const char*, 3> kWords = {"good", "look", "bad"};
constexpr std::size_t kSubjectWidth = 11;

// People wait for two commits, their own and that of whom they answer; a fifth of a second is felt as a delay. [s]
constexpr double kSlowCommit = 0.02, kBadCommit = 0.05, kSlowestCommit = 0.25;
// A session of two hours with fifty people writes less than 50 MB; the system and the browser want more.
constexpr std::int64_t kLowDisk = 1 << 30, kBadDisk = 200 << 20;
constexpr std::int64_t kLowMemory = 1 << 30, kBadMemory = 256 << 20;
constexpr double kLowBattery = 0.3;
// A tick that takes more than this share of the time between two leaves too little for what people say meanwhile.
constexpr double kBusy = 0.5, kTooBusy = 0.95;
// In a room that runs, ticks come late from the first share on. From the second one on, half of them are missing.
constexpr double kBehind = 0.8, kFarBehind = 2;
constexpr double kWeakWireless = 0.4;
// What comes within a quarter of a second feels as if it followed at once; whoever waits for two seconds presses again. [s]
constexpr double kSlowToFeel = 0.25, kTooSlowToFeel = 2;
// Whoever sees it a week ahead still has the time to get another one. [ms]
constexpr std::int64_t kSoon = std::int64_t{7} * 24 * 3600 * 1000;

std::string percent(double share) { return std::to_string(static_cast<int>(100 * share + 0.5)) + " %"; }
std::string size(std::int64_t bytes) {
  constexpr double kMegabyte = 1e6, kGigabyte = 1e9;
  const auto count = static_cast<double>(bytes);
  return count < kGigabyte ? reading::readable(count / kMegabyte) + " MB" : reading::readable(count / kGigabyte) + " GB";
}

Finding judge_size(const char* subject, std::optional<std::int64_t> bytes, std::int64_t low, std::int64_t bad,
                   const std::string& of, const std::string& advice) {
  if (!bytes) return {Verdict::look, subject, "The system does not say how much is free " + of + "."};
  const Verdict verdict = *bytes < bad ? Verdict::bad : *bytes < low ? Verdict::look : Verdict::good;
  return {verdict, subject, size(*bytes) + " are free " + of + "." + (verdict == Verdict::good ? "" : " " + advice)};
}

}  // namespace

const char* word_of(Verdict verdict) { return kWords[static_cast<std::size_t>(verdict)]; }

std::string line_of(const Finding& finding) {
  std::string line = word_of(finding.verdict);
  line.resize(6, ' ');
  line += finding.subject;
  line.resize(std::max(line.size() + 1, 6 + kSubjectWidth), ' ');
  std::string text = finding.text;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return line + text;
}

std::optional<Finding> finding_of_line(const std::string& line) {
  for (std::size_t k = 0; k < kWords.size(); ++k) {
    if (!line.starts_with(std::string(kWords[k]) + " ")) continue;
    const std::size_t subject = line.find_first_not_of(' ', std::string(kWords[k]).size());
    const std::size_t end = subject == std::string::npos ? subject : line.find(' ', subject);
    const std::size_t text = end == std::string::npos ? end : line.find_first_not_of(' ', end);
    if (text == std::string::npos) return std::nullopt;
    return Finding{static_cast<Verdict>(k), line.substr(subject, end - subject), line.substr(text)};
  }
  return std::nullopt;
}

Finding judge_commits(const Durations& times) {
  const std::string figure = "Storing takes " + reading::duration(times.median) + " mostly and " +
                             reading::duration(times.worst) + " at worst, of " + std::to_string(times.count) + " times.";
  if (times.median > kBadCommit)
    return {Verdict::bad, "disk",
            figure +
                " Every answer waits for that. Put the session file on a disk inside this computer, and not "
                "on a memory card, a stick or a drive of the network."};
  if (times.median > kSlowCommit || times.worst > kSlowestCommit)
    return {Verdict::look, "disk", figure + " People feel such a delay. Close what else writes to this disk, and check again."};
  return {Verdict::good, "disk", figure};
}

Finding judge_free_disk(std::optional<std::int64_t> bytes) {
  return judge_size("space", bytes, kLowDisk, kBadDisk, "on the disk of the session file",
                    "Remove what you do not need: when the disk is full, nothing is stored any more.");
}

Finding judge_memory(std::optional<std::int64_t> bytes) {
  return judge_size("memory", bytes, kLowMemory, kBadMemory, "in the memory", "Close other programs.");
}

Finding judge_power(const Machine& machine) {
  if (!machine.battery) {
    if (!machine.is_on_mains || *machine.is_on_mains)
      return {Verdict::good, "power", "This computer has no battery and runs on mains."};
    return {Verdict::look, "power", "The power supply says that it is not plugged in."};
  }
  const std::string figure = "The battery is at " + percent(*machine.battery);
  if (machine.is_on_mains.value_or(false)) return {Verdict::good, "power", figure + ", and the computer is plugged in."};
  const Verdict verdict = *machine.battery < kLowBattery ? Verdict::bad : Verdict::look;
  return {verdict, "power", figure + ", and the computer is not plugged in. Plug it in, and switch off its sleep."};
}

Finding judge_clock(std::optional<bool> is_set) {
  if (is_set.value_or(false)) return {Verdict::good, "clock", "The clock is set by a time server."};
  const std::string what = is_set ? "The clock follows no time server." : "The system does not say whether its clock is right.";
  return {Verdict::look, "clock", what + " Compare it with a phone: the minutes have its times, and phones count down to them."};
}

Finding judge_ticks(const Durations& times, double rate) {
  const double most = 1 / rate;
  const std::string figure = "A tick of the scene takes " + reading::duration(times.median) + " mostly and " +
                             reading::duration(times.worst) + " at worst. At " + shortest(rate) + " ticks a second it may take " +
                             reading::duration(most) + ".";
  if (times.median > kTooBusy * most)
    return {Verdict::bad, "ticks",
            figure + " The scene is too slow for this computer. Take a smaller scene, or set fewer ticks a second in the room."};
  if (times.median > kBusy * most || times.worst > kTooBusy * most)
    return {Verdict::look, "ticks", figure + " This is close. Close other programs, or set fewer ticks a second in the room."};
  return {Verdict::good, "ticks", figure};
}

Finding judge_pace(double tick_seconds, double rate, bool is_paused) {
  const double share = is_paused ? 0 : tick_seconds * rate;
  const Verdict verdict = share > kFarBehind ? Verdict::bad : share > kBehind ? Verdict::look : Verdict::good;
  const std::string wanted = is_paused ? "The model is paused." : shortest(rate) + " ticks a second are wanted.";
  return {verdict, "ticks",
          "A tick takes " + reading::duration(tick_seconds) + " on the server. " + wanted +
              (verdict != Verdict::good ? " The model is slower than it should be: close other programs there." : "")};
}

Finding judge_storing(double median, double slow) {
  const Verdict verdict = median > kBadCommit ? Verdict::bad : slow > kBadCommit ? Verdict::look : Verdict::good;
  return {verdict, "disk",
          "Storing takes " + reading::duration(median) + ", seldom more than " + reading::duration(slow) + "." +
              (verdict != Verdict::good ? " People feel such a delay: close what else writes to this disk." : "")};
}

Finding judge_wireless(const std::string& interface, double quality) {
  const bool is_weak = quality < kWeakWireless;
  return {is_weak ? Verdict::look : Verdict::good, "network",
          "The Wi-Fi of " + interface + " is at " + percent(quality) + "." +
              (is_weak ? " That is weak: stand nearer to the router, or use a cable." : "")};
}

Finding judge_reach(const std::string& url, std::size_t count) {
  if (count > 0) return {Verdict::good, "network", reading::counted(count, "other device") + " reached " + url + "."};
  return {
      Verdict::look, "network",
      "Nobody has reached " + url +
          " yet. Open it on a phone. If that fails, the Wi-Fi keeps its guests apart or a firewall closes the port; use a router "
          "of your own."};
}

Finding judge_address(const NetworkAddress& address, const std::string& url, const Machine& machine,
                      std::optional<std::size_t> reached) {
  const auto radio = machine.wireless.find(address.interface);
  const bool is_radio = radio != machine.wireless.end();
  Finding finding{address.is_private ? Verdict::good : Verdict::look, "network",
                  url + " (" + address.interface + (is_radio ? ", Wi-Fi" : ", no Wi-Fi") + ") is an address of " +
                      (address.is_private ? "this network alone."
                                          : "the Internet. Whoever finds it may come in where no firewall stands before it.")};
  const auto add = [&finding](const Finding& more) {
    finding.verdict = std::max(finding.verdict, more.verdict);
    finding.text += " " + more.text;
  };
  if (is_radio) add(judge_wireless(address.interface, radio->second));
  if (reached) add(judge_reach("it", *reached));
  else add({Verdict::good, "", "Open the room, then the address on a phone: only that shows that phones reach it."});
  return finding;
}

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& one : names) all += (all.empty() ? "" : ", ") + one;
  return all;
}

// Whether those who come by these hosts will believe the certificate; empty where nothing stands against it.
std::string doubt_of(const Certificate& certificate, const std::vector<std::string>& hosts) {
  if (hosts.empty()) return "Look whether its names hold the address that people open.";
  if (certificate.fitting.empty())
    return "Browsers will warn people who open " + joined(hosts) + ": it is not made for that. Take a certificate for " +
           (hosts.size() > 1 ? "one of these addresses" : hosts.front()) + ", or say with --name which name people open.";
  if (certificate.is_of_itself)
    return "Browsers will warn people, because no authority has signed it. Take one that an authority has signed.";
  return "";
}

}  // namespace

Finding judge_certificate(const Result<Certificate>& certificate, const std::vector<std::string>& hosts, std::int64_t now) {
  const auto finding = [](Verdict verdict, std::string text) { return Finding{verdict, "encryption", std::move(text)}; };
  if (!certificate) return finding(Verdict::bad, certificate.error().text() + ".");
  const std::string of = certificate->subject.empty() ? "" : " of " + certificate->subject;
  const std::string names = certificate->names.empty() ? "no name of a host" : joined(certificate->names);
  const std::string what = "The certificate" + of + " for " + names;
  if (!certificate->fits_key)
    return finding(Verdict::bad, what + " has another key than the one in the file of --key, so the room cannot be opened.");
  if (now >= certificate->ends)
    return finding(Verdict::bad,
                   what + " has ended on " + moment_text(certificate->ends) + ". Browsers refuse it. Get a new one.");
  if (now < certificate->begins)
    return finding(Verdict::bad, what + " is not valid before " + moment_text(certificate->begins) +
                                     ". Browsers refuse it. Look whether the clock of this computer is right.");
  std::string text = "Connections are encrypted. " + what + " ends on " + moment_text(certificate->ends) + ".";
  const bool is_soon = certificate->ends - now <= kSoon;
  if (is_soon) text += " That is soon: get a new one before the session.";
  const std::string doubt = doubt_of(*certificate, hosts);
  if (!doubt.empty()) text += " " + doubt;
  else if (!is_soon) text += " Phones believe it where they know the authority that has signed it.";
  return finding(is_soon || !doubt.empty() ? Verdict::look : Verdict::good, text);
}

namespace {

Finding judge_wait(const char* subject, const std::string& what, const std::optional<double>& seconds) {
  if (!seconds) return {Verdict::look, subject, "Nothing of this was seen. Let more bots take part, or for longer."};
  const Verdict verdict = *seconds > kTooSlowToFeel ? Verdict::bad : *seconds > kSlowToFeel ? Verdict::look : Verdict::good;
  return {verdict, subject,
          "Of 100 " + what + " within " + reading::duration(*seconds) + "." +
              (verdict == Verdict::good ? "" : " People feel such a wait. Close other programs, or take a smaller scene.")};
}

}  // namespace

std::vector<Finding> judge_rehearsal(const Rehearsed& r) {
  const std::size_t absent = r.bots - r.came;
  std::vector<Finding> findings;
  findings.push_back({absent > 0               ? Verdict::bad
                      : r.lost_connections > 0 ? Verdict::look
                                               : Verdict::good,
                      "people",
                      std::to_string(r.came) + " of " + std::to_string(r.bots) +
                          " bots came in. Connections that were lost: " + std::to_string(r.lost_connections) + "." +
                          (absent > 0 && !r.why_absent.empty() ? " The last reason: " + r.why_absent + "." : "")});
  Finding answers = judge_wait("answers", "operations 95 were answered", r.answers);
  answers.text = std::to_string(r.said) + " operations: " + std::to_string(r.unanswered) + " without an answer, " +
                 std::to_string(r.refused) + " refused. " + answers.text;
  if (r.unanswered > 0) answers.verdict = Verdict::bad;
  findings.push_back(std::move(answers));
  findings.push_back({r.lost + r.doubled > 0 ? Verdict::bad : Verdict::good, "stored",
                      std::to_string(r.lost) + " lost of " + std::to_string(r.told) + " stored comments and proposals, and " +
                          std::to_string(r.doubled) + " operations stored twice."});
  findings.push_back(judge_wait("screens", "comments and proposals 95 were on all screens", r.screens));
  return findings;
}

}  // namespace bl::serve
