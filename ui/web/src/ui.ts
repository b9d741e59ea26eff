// What is on the screen now, apart from the room: the tab, what is chosen, and what the plan does when it is touched.
import { useEffect, useLayoutEffect, useReducer, useRef, useState } from "preact/hooks";
import type { Ballot, Point } from "./wire";

export type Tab = "now" | "plan" | "card" | "votes" | "ideas" | "lead" | "form" | "you";

/// A mark on the plan. `letter` is short; `tone` is a class of the style sheet.
export interface Pin {
  id: string;
  x: number;
  y: number;
  letter: string;
  tone: string;
  label: string;
}
/// A polygon on the plan, such as the outline of an area.
export interface Outline {
  id: string;
  corners: [number, number][]; ///< [m]
  name: string;
  isOpen?: boolean; ///< it is still being drawn
}
export interface Binding {
  pins: Pin[];
  outlines?: Outline[];
  /// `reach`: how far a finger that means a place may miss it [m]; nobody knows that of the picture in three dimensions.
  onTap(place: Point, node: string | null, reach?: number): void;
}

/// Keys that belong to the browser, such as Ctrl and + to enlarge the page.
export const is_of_browser = (event: KeyboardEvent): boolean => event.ctrlKey || event.metaKey || event.altKey;

export class Ui {
  tab: Tab = "now";
  selected: string | null = null; ///< a node
  place: Point | null = null; ///< of a comment or a form that is being written
  parent: string | null = null; ///< the comment that is being answered
  isWriting = false;
  part: "comments" | "proposals" = "comments";
  draft: { id: string; title: string } | null = null;
  ballots: Record<string, Ballot | null> = {};
  isCodeLarge = false;
  isToPens = false; ///< somebody was led to the pens of their areas
  binding: Binding | null = null; ///< of the plan that stands beside the screen
  private watchers = new Set<() => void>();

  set(change: Partial<Ui>): void {
    Object.assign(this, change);
    this.tell();
  }
  go(tab: Tab): void {
    this.set({ tab });
    const title = document.querySelector<HTMLElement>("main h1");
    if (title) title.focus();
  }
  watch(watcher: () => void): () => void {
    this.watchers.add(watcher);
    return () => this.watchers.delete(watcher);
  }
  tell(): void {
    for (const watcher of [...this.watchers]) watcher();
  }
}

/// Draws the component again whenever one of them changes. It listens before the browser paints: what comes between the two would
/// not be seen until something else comes.
export function useWatched(...sources: { watch(watcher: () => void): () => void }[]): void {
  const [, again] = useReducer((count: number) => count + 1, 0);
  useLayoutEffect(() => {
    const ends = sources.map((source) => source.watch(() => again(undefined as never)));
    return () => ends.forEach((end) => end());
  }, sources);
}

export function useMedia(query: string): boolean {
  const [matches, set] = useState(() => window.matchMedia(query).matches);
  useEffect(() => {
    const media = window.matchMedia(query),
      change = () => set(media.matches);
    change();
    media.addListener(change);
    return () => media.removeListener(change);
  }, [query]);
  return matches;
}

/// Is there room for the plan beside the screen?
export const useWide = (): boolean => useMedia("(min-width: 900px)");

/// False until the browser has had time to paint and to hear touches: for what a screen can begin without.
export function useLater(): boolean {
  const [isLater, set] = useState(false);
  useEffect(() => {
    const timer = window.setTimeout(() => set(true));
    return () => window.clearTimeout(timer);
  }, []);
  return isLater;
}

/// The server tries these drafts while the caller is on the screen.
export function useLook(s: { look(drafts: string[]): void }, drafts: string[]): void {
  useEffect(() => {
    s.look(drafts);
    return () => s.look([]);
  }, [drafts.join()]);
}

/// Draws again every so often, for clocks.
export function useClock(milliseconds: number): void {
  const [, again] = useReducer((count: number) => count + 1, 0);
  useEffect(() => {
    const timer = window.setInterval(() => again(undefined as never), milliseconds);
    return () => window.clearInterval(timer);
  }, [milliseconds]);
}

/// The plan beside the screen shows these pins and tells these taps while the caller is on the screen.
export function useBinding(ui: Ui, binding: Binding | null): void {
  const drawn = binding ? JSON.stringify([binding.pins, binding.outlines]) : "";
  const latest = useRef(binding);
  latest.current = binding;
  useLayoutEffect(() => {
    if (!latest.current) return;
    const { pins, outlines } = latest.current,
      own: Binding = { pins, outlines, onTap: (...tap) => latest.current?.onTap(...tap) };
    ui.binding = own;
    ui.tell();
    return () => {
      if (ui.binding !== own) return;
      ui.binding = null;
      ui.tell();
    };
  }, [drawn, binding === null]);
}
