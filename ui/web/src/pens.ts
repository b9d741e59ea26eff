// Pens of areas: whose they can be, and where they are shown.
import type { Session } from "./session";

type Told = Pick<Session, "you" | "views">;

/// The areas whose pen this person can have, as long as the session lasts.
export function own_pens({ you, views: { room } }: Told): string[] {
  if (room.closed || (you?.role !== "designer" && you?.role !== "stakeholder")) return [];
  return you.areas.filter((area) => room.areas?.[area] !== undefined);
}

/// Designers work on the plan, and who has a role card on its values.
export const tab_of_pens = ({ you, views: { card } }: Told): "plan" | "card" =>
  you?.role === "stakeholder" && (card.controls ?? []).length > 0 ? "card" : "plan";

/// Those who may work in an area, and who has its pen: to them it can be given.
export function writers_of({ views: { room } }: Told, area: string): number[] {
  const pen = room.areas?.[area]?.pen ?? 0;
  return Object.entries(room.seats ?? {})
    .map(([number, seat]): [number, typeof seat] => [Number(number), seat])
    .filter(([number, seat]) => number === pen || ((seat.role === "designer" || seat.role === "stakeholder") && seat.areas?.includes(area) === true))
    .map(([number]) => number);
}
