// What a connection needs of the outside, and what it tells its caller.
import type { Item, Store } from "./queue";
import type { Json, ViewName, Welcome, Why } from "./wire";

/// A WebSocket, as far as it is used here.
export interface Link {
  send(text: string): void;
  close(): void;
  onopen: (() => void) | null;
  onmessage: ((text: string) => void) | null;
  onclose: ((code: number, reason: string) => void) | null;
  greeted?: string | null; ///< the run by which hello was said on it already
}

/// Everything outside: the clock, the sockets, the store, chance, and whether anybody looks.
export interface World {
  now(): number;
  set(milliseconds: number, then: () => void): number;
  clear(timer: number): void;
  open(): Link;
  /// Asks the server by HTTP whether it is there. `then` is called once, unless the asking is ended by what is given back.
  ask(then: (isThere: boolean) => void): () => void;
  store: Store;
  chance(): number; ///< in [0, 1)
  name(): string; ///< a new random name
  isVisible(): boolean;
}

export type Answer =
  | { kind: "saved"; seq: number; tick: number }
  | { kind: "refused"; why: Why | "seat"; place: string; text: string; args: Record<string, Json> }
  | { kind: "elsewhere" }; ///< another page of this person sends it

export type Stage = "connecting" | "open" | "waiting" | "door" | "removed" | "old";

export interface Listener {
  changed(): void;
  welcomed(welcome: Welcome): void;
  told(message: { t: string; [key: string]: unknown }): void;
  answered(item: Item, answer: Answer): void;
  reload(): void;
}

/// What the beginning of the script has started (early.ts): a socket, and files of words by language. `run`: it has said hello by
/// this run, and `heard` what came; `closed` is how the server has ended it, where it has: then nobody need ask once more.
export interface Early {
  socket: WebSocket | null;
  run: string | null;
  heard: unknown[];
  closed: { code: number; reason: string } | null;
  words: Record<string, Promise<unknown>>;
  files: Record<string, string>;
}

export interface Options {
  room: string;
  prefix: string; ///< of the keys in the store; another one for the beamer of the same machine
  run: string | null; ///< of this page's life before a reload
  lang: string;
  views: ViewName[];
  invite: string | null;
  here: string; ///< the origin of the page, such as `http://192.168.1.5:8080`
  isBeamer?: boolean;
}
