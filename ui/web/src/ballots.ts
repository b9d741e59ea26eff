// Ballots of all five kinds: what is still missing, and the small steps by which people fill them in.
import type { Ballot, Dot, Vote } from "./wire";

export type Question = Pick<Vote, "kind" | "options" | "points" | "whole" | "least" | "most">;

/// What keeps a ballot from counting; `n` is how many are missing.
export type Gap = { what: "answer" | "rank" | "rank_all" | "coins" | "dots" | "number" | "too_many"; n: number };

const ids = (question: Question): Set<string> => new Set(question.options.map((option) => option.id));

/// Null where the ballot counts. The room checks the same (core/vote); here people learn it before they send.
export function gap_of(question: Question, ballot: Ballot | null): Gap | null {
  switch (question.kind) {
    case "yes_no":
      return ballot === "yes" || ballot === "no" ? null : { what: "answer", n: 1 };
    case "rank": {
      const ranked = ranking(question, ballot).length,
        all = question.options.length;
      if (ranked === 0 && !question.whole) return { what: "rank", n: 1 };
      return question.whole && ranked < all ? { what: "rank_all", n: all - ranked } : null;
    }
    case "coins": {
      const left = coins_left(question, ballot);
      if (left < 0) return { what: "too_many", n: -left };
      return left === question.points ? { what: "coins", n: 1 } : null;
    }
    case "dots": {
      const set = dots(question, ballot).length;
      if (set > question.points) return { what: "too_many", n: set - question.points };
      return set === 0 ? { what: "dots", n: 1 } : null;
    }
    case "slider": {
      if (typeof ballot !== "number" || !Number.isFinite(ballot)) return { what: "number", n: 1 };
      return ballot >= question.least && ballot <= question.most ? null : { what: "number", n: 1 };
    }
  }
}

/// The options that a ranking names, without those that are gone.
export function ranking(question: Question, ballot: Ballot | null): string[] {
  const known = ids(question);
  return Array.isArray(ballot) ? (ballot as unknown[]).filter((id): id is string => typeof id === "string" && known.has(id)) : [];
}

export function rank_added(question: Question, ballot: Ballot | null, id: string): string[] {
  const ranked = ranking(question, ballot);
  return ranked.includes(id) ? ranked : [...ranked, id];
}

/// Moves an option up (-1) or down (+1).
export function rank_moved(question: Question, ballot: Ballot | null, id: string, by: -1 | 1): string[] {
  const ranked = ranking(question, ballot),
    at = ranked.indexOf(id),
    to = at + by;
  const other = ranked[to];
  if (at < 0 || other === undefined) return ranked;
  ranked[to] = id;
  ranked[at] = other;
  return ranked;
}

export function coins(question: Question, ballot: Ballot | null): Record<string, number> {
  const known = ids(question),
    out: Record<string, number> = {};
  if (ballot === null || typeof ballot !== "object" || Array.isArray(ballot)) return out;
  for (const [id, count] of Object.entries(ballot)) if (known.has(id) && count > 0) out[id] = Math.floor(count);
  return out;
}

export function coins_left(question: Question, ballot: Ballot | null): number {
  return question.points - Object.values(coins(question, ballot)).reduce((sum, count) => sum + count, 0);
}

export function coins_put(question: Question, ballot: Ballot | null, id: string, by: -1 | 1): Record<string, number> {
  const out = coins(question, ballot),
    count = (out[id] ?? 0) + by;
  if (count < 0 || (by > 0 && coins_left(question, ballot) <= 0)) return out;
  if (count === 0) delete out[id];
  else out[id] = count;
  return out;
}

export function dots(question: Question, ballot: Ballot | null): Dot[] {
  const known = ids(question);
  if (!Array.isArray(ballot)) return [];
  return (ballot as unknown[]).filter(
    (dot): dot is Dot => typeof dot === "object" && dot !== null && known.has((dot as Dot).option) && Array.isArray((dot as Dot).place),
  );
}

export function same(a: unknown, b: unknown): boolean {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return false;
  if (Array.isArray(a) !== Array.isArray(b)) return false;
  const keys = Object.keys(a),
    others = Object.keys(b);
  return (
    keys.length === others.length && keys.every((key) => same((a as Record<string, unknown>)[key], (b as Record<string, unknown>)[key]))
  );
}
