// The beginning of the page's script, which stands in the page itself: what it starts goes on while the rest is still coming.
import { hello_of, kFirstViews } from "./hello";
import { random_name } from "./random";
import type { Early } from "./world";

// Those that come as files of their own; English stands in the page's script. The build fills in the addresses.
declare const WORDS: Record<string, string>;

const hash = window.location.hash,
  room = window.location.pathname.slice(1).toUpperCase();

// What is kept of this room; null where the browser does not tell.
function kept(): string[] | null {
  try {
    return [...Object.keys(window.localStorage), ...Object.keys(window.sessionStorage)].filter((key) => key.startsWith(`bl1/${room}/`));
  } catch {
    return null;
  }
}

// The preferred language, as the page finds it later; by hand here, because each byte of this file delays the page.
function language(): string {
  let chosen = "";
  try {
    chosen = window.localStorage.getItem("bl1/page/language") ?? "";
  } catch {
    // A browser that keeps nothing has its own languages.
  }
  for (const one of [/[#&]lang=(\w\w)/.exec(hash)?.[1] ?? "", chosen, ...navigator.languages]) {
    const short = one.slice(0, 2).toLowerCase();
    if (short === "en" || short === "xx" || WORDS[short]) return short;
  }
  return "en";
}

const early: Early = { socket: null, run: null, heard: [], closed: null, words: {}, files: WORDS };
// Two round trips of a handshake cost nothing while the script is on its way. It comes first: a browser takes time to read what it keeps.
const socket = /^\w+$/.test(room)
  ? new WebSocket(`${window.location.protocol === "https:" ? "wss:" : "ws:"}//${window.location.host}/ws`, "bl1")
  : null;
const lang = language(),
  file = WORDS[lang];
if (file) early.words[lang] = import(file);

// Who has not been here before has no seat and no queue, and is greeted as well.
if (socket !== null) {
  early.socket = socket;
  const isNew = kept()?.length === 0 && !/[#&][tq]=/.test(hash);
  if (isNew) {
    const isBeamer = /[#&]beamer\b/.test(hash),
      invite = /[#&]k=([^&]+)/.exec(hash)?.[1] ?? null,
      run = random_name((bytes) => window.crypto.getRandomValues(bytes));
    early.run = run;
    socket.onopen = () =>
      socket.send(
        JSON.stringify(
          hello_of({
            room,
            run,
            isBeamer,
            token: null,
            invite,
            unacked: 0,
            views: kFirstViews[isBeamer ? "beamer" : "page"],
            lang: lang === "xx" ? "en" : lang,
          }),
        ),
      );
    socket.onmessage = (event) => early.heard.push(event.data);
    socket.onclose = ({ code, reason }) => (early.closed = { code, reason });
  }
}
(window as unknown as { early: Early }).early = early;
