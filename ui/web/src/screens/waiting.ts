// What waits for the facilitator: it is counted on the tab as well, before the script of that page is here.
import type { Session } from "../session";
import type { Proposal, Seat } from "../wire";

export const proposals_waiting = (s: Session): [string, Proposal][] =>
  Object.entries(s.views.proposals).filter(([, proposal]) => proposal.state === "proposed");

/// Those who stand at the door now.
export const at_door = (s: Session): [string, Seat][] =>
  Object.entries(s.views.room.seats ?? {}).filter(([, seat]) => seat.waits === true && seat.here);

/// The areas whose pen somebody asks for.
export const pens_asked = (s: Session): string[] =>
  Object.entries(s.views.room.areas ?? {})
    .filter(([, area]) => area.asking.length > 0)
    .map(([id]) => id);
