// How the room and its computer are, as sentences for the facilitator: what needs somebody comes first.
import { amount, duration, number, share } from "../format";
import type { Health, Verdict } from "../wire";
import { Key, t } from "./words";

export interface Finding {
  verdict: Verdict;
  text: string; ///< the figure
  advice: string; ///< what to do; empty where there is nothing to do
}

const kWorse: Verdict[] = ["bad", "look", "good"];

// From bytes.
const size = (bytes: number): string => (bytes < 1e9 ? amount(bytes / 1e6, "MB") : amount(bytes / 1e9, "GB"));

function of_power({ battery, mains }: Health): string | null {
  if (battery < 0) return mains === "no" ? t("health_mains_off") : mains === "yes" ? t("health_mains") : null;
  return t(mains === "yes" ? "health_battery_mains" : "health_battery", { share: share(battery) });
}

/// What stands still or cannot be stored has no verdict of its own: it is always bad. A number below 0 is one that nobody knows.
export function findings_of(health: Health, isPaused: boolean, name_of: (node: string) => string): Finding[] {
  const all: Finding[] = [];
  const say = (figure: string, text: string | null, advice: Key, fallback: Verdict = "good"): void => {
    const verdict = health.verdicts[figure] ?? fallback;
    if (text !== null) all.push({ verdict, text, advice: verdict === "good" ? "" : t(advice) });
  };
  const plain = (text: string): void => void all.push({ verdict: "good", text, advice: "" });
  if (health.failure) say("", t("health_failure", { why: health.failure }), "health_failure_do", "bad");
  if (health.problem) say("", t("health_problem", { why: health.problem }), "health_problem_do", "bad");
  const wanted = isPaused ? t("health_paused") : t("health_wanted", { rate: number(health.wanted) });
  say("ticks", `${t("health_ticks", { time: amount(health.tick_ms, "ms") })} ${wanted}`, "health_ticks_do");
  say("disk", t("health_disk", { time: amount(health.disk_ms, "ms"), slow: amount(health.disk_slow_ms, "ms") }), "health_disk_do");
  say("power", of_power(health), "health_power_do");
  say("memory", health.memory_free < 0 ? null : t("health_memory", { size: size(health.memory_free) }), "health_memory_do");
  say("space", health.disk_free < 0 ? null : t("health_space", { size: size(health.disk_free) }), "health_space_do");
  for (const [name, quality] of Object.entries(health.wireless))
    say(`wireless/${name}`, t("health_wireless", { name, share: share(quality) }), "health_wireless_do");
  for (const [address, n] of Object.entries(health.reached))
    say(`reached/${address}`, n > 0 ? t("health_reached", { n, address }) : t("health_unreached", { address }), "health_unreached_do");
  plain(t(health.settled ? "health_settled" : "health_moves"));
  if (health.worst_of) plain(t("health_worst", { share: share(health.worst), what: name_of(health.worst_of) }));
  if (health.journal >= 0) plain(t("health_journal", { size: size(health.journal) }));
  plain(health.snapshot_age < 0 ? t("health_no_snapshot") : t("health_snapshot", { time: duration(1000 * health.snapshot_age) }));
  plain(health.followers > 0 ? t("health_followers", { n: health.followers }) : t("health_no_follower"));
  // Sorting keeps the order of equals.
  return all.sort((a, b) => kWorse.indexOf(a.verdict) - kWorse.indexOf(b.verdict));
}
