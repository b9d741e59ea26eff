// The world of the connection in a browser: sockets, localStorage, clock and chance, all without a secure context.
import { random_name } from "./queue";
import type { Store } from "./queue";
import type { Link, World } from "./world";

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

function open(address: string): Link {
  const socket = new WebSocket(address, "bl1");
  const link: Link = {
    onopen: null,
    onmessage: null,
    onclose: null,
    send: (text) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(text);
    },
    close: () => socket.close(),
  };
  socket.onopen = () => link.onopen?.();
  socket.onmessage = (event) => {
    if (typeof event.data === "string") link.onmessage?.(event.data);
  };
  socket.onclose = (event) => link.onclose?.(event.code, event.reason);
  return link;
}

export function browser_world(address: string): World {
  return {
    now: () => Date.now(),
    set: (milliseconds, then) => window.setTimeout(then, milliseconds),
    clear: (timer) => window.clearTimeout(timer),
    open: () => open(address),
    store,
    chance: () => Math.random(),
    name: () => random_name((bytes) => window.crypto.getRandomValues(bytes)),
    isVisible: () => document.visibilityState === "visible",
  };
}
