// The world of the connection in a browser: sockets, localStorage, clock and chance, all without a secure context.
import { random_name } from "./random";
import type { Store } from "./queue";
import type { Early, Link, World } from "./world";
import { Language, Table, add_table, best_language, set_language } from "./words";

/// localStorage, or memory where the browser refuses it; what did not fit is told by `set`.
export function browser_store(): Store {
  const memory = new Map<string, string>();
  const storage = ((): Storage | null => {
    try {
      return window.localStorage;
    } catch {
      return null;
    }
  })();
  return {
    get: (key) => memory.get(key) ?? storage?.getItem(key) ?? null,
    set(key, text) {
      try {
        if (!storage) throw new Error("none");
        storage.setItem(key, text);
        memory.delete(key);
        return true;
      } catch {
        memory.set(key, text);
        return false;
      }
    },
    remove(key) {
      memory.delete(key);
      storage?.removeItem(key);
    },
    keys() {
      const all = new Set(memory.keys());
      for (let i = 0; storage && i < storage.length; ++i) all.add(storage.key(i) ?? "");
      return [...all];
    },
  };
}

/// Of this tab alone, also over a reload.
export function tab_kept(key: string): string | null {
  try {
    return window.sessionStorage.getItem(key);
  } catch {
    return null;
  }
}
export function tab_keep(key: string, text: string): void {
  try {
    window.sessionStorage.setItem(key, text);
  } catch {
    // A browser that refuses it begins a new run after a reload, and finds what the old one has left.
  }
}

const store = browser_store();
export const kept = (key: string): string | null => store.get(`bl1/page/${key}`);
export const keep = (key: string, text: string): boolean => store.set(`bl1/page/${key}`, text);

export function socket_address(): string {
  return `${window.location.protocol === "https:" ? "wss:" : "ws:"}//${window.location.host}/ws`;
}

const early = (window as unknown as { early?: Early }).early;

/// Speaks another language once its words are here. Where they cannot be had, the page goes on as it is.
export async function speak(language: Language): Promise<void> {
  const file = early?.files[language];
  if (early && file) {
    try {
      const words = (await (early.words[language] ??= import(file))) as Record<string, Table>;
      add_table(language, words[language] as Table);
    } catch {
      delete early.words[language]; // the next try asks again
    }
  }
  set_language(language);
}

/// The language of this person: the one that was chosen, or one of the browser's.
export const wanted_language = (chosen: Language | null): Language =>
  chosen ?? best_language([kept("language") ?? "", ...navigator.languages]);

// A code of our own server, and none of a network that has failed.
const kFirstCode = 4000;

// The first connection was begun before this script had come. Where the server has ended it, it has said why.
function early_socket(): WebSocket | null {
  const socket = early?.socket ?? null;
  if (early === undefined || socket === null) return null;
  const isTold = early.run !== null && (socket.readyState === WebSocket.CLOSING || (early.closed?.code ?? 0) >= kFirstCode);
  return socket.readyState <= WebSocket.OPEN || isTold ? socket : null;
}

/// The run by which hello was said already, on a connection that lives or that the server has answered by ending it.
export const early_run = (): string | null => (early_socket() === null ? null : (early?.run ?? null));

function open(address: string): Link {
  const begun = early_socket(),
    socket = begun ?? new WebSocket(address, "bl1");
  if (early) early.socket = null;
  const link: Link = {
    onopen: null,
    onmessage: null,
    onclose: null,
    greeted: begun === null ? null : (early?.run ?? null),
    send: (text) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(text);
    },
    close: () => socket.close(),
  };
  const hear = (data: unknown): void => {
    if (typeof data === "string") link.onmessage?.(data);
  };
  const opened = (): void => {
    link.onopen?.();
    if (begun !== null) early?.heard.splice(0).forEach(hear);
  };
  const ended = begun === null ? null : (early?.closed ?? null);
  if (ended !== null) void Promise.resolve().then(() => link.onclose?.(ended.code, ended.reason));
  else if (socket.readyState === WebSocket.OPEN) void Promise.resolve().then(opened);
  // Where hello is to be said at the opening, the one who says it does so first.
  else socket.addEventListener("open", opened);
  socket.onmessage = (event) => hear(event.data);
  socket.onclose = (event) => link.onclose?.(event.code, event.reason);
  return link;
}

// An answer that takes longer is not waited for: what was sent while the network was away is sent again too late [ms].
const kAskFor = 2000;

// Where the server answers at all, it is there, whatever it says; a proxy that misses it says so by a number from 500 on.
function ask(then: (isThere: boolean) => void): () => void {
  const control = new AbortController(),
    timer = window.setTimeout(() => control.abort(), kAskFor);
  let isWanted = true;
  const answer = (isThere: boolean): void => {
    window.clearTimeout(timer);
    if (isWanted) then(isThere);
  };
  fetch("/health", { method: "HEAD", cache: "no-store", signal: control.signal }).then(
    (response) => answer(response.status < 500),
    () => answer(false),
  );
  return () => {
    isWanted = false;
    control.abort();
  };
}

export function browser_world(address: string): World {
  return {
    now: () => Date.now(),
    set: (milliseconds, then) => window.setTimeout(then, milliseconds),
    clear: (timer) => window.clearTimeout(timer),
    open: () => open(address),
    ask,
    store,
    chance: () => Math.random(),
    name: () => random_name((bytes) => window.crypto.getRandomValues(bytes)),
    isVisible: () => document.visibilityState === "visible",
  };
}
