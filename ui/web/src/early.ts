// The beginning of the page's script, which stands in the page itself: what it starts goes on while the rest is still coming.
import type { Early } from "./world";

// Those that come as files of their own; English stands in the page's script. The build fills in the addresses.
declare const WORDS: Record<string, string>;

// The preferred language, as `best_language` finds it; by hand here, because each byte of this file delays the page.
function language(): string {
  const named = /[#&]lang=(\w\w)/.exec(window.location.hash);
  let kept: string | null = null;
  try {
    kept = window.localStorage.getItem("bl1/page/language");
  } catch {
    // A browser that keeps nothing has its own languages.
  }
  for (const one of [...(named ? [named[1] as string] : []), kept ?? "", ...navigator.languages]) {
    const short = one.slice(0, 2).toLowerCase();
    if (short === "en" || short === "xx" || WORDS[short]) return short;
  }
  return "en";
}

const early: Early = { socket: null, words: {}, files: WORDS };
const first = language(),
  file = WORDS[first];
if (file) early.words[first] = import(file);
// The handshake takes two round trips. It costs nothing while the script is on its way.
if (window.location.pathname.length > 1)
  early.socket = new WebSocket(`${window.location.protocol === "https:" ? "wss:" : "ws:"}//${window.location.host}/ws`, "bl1");
(window as unknown as { early: Early }).early = early;
