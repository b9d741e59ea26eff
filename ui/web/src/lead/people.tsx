// The people of a room, for the facilitator: who waits at the door, roles, cards, areas, mute, remove.
import type { JSX } from "preact";
import { Avatar, MarkState, Sure } from "../parts";
import { at_door } from "../screens/waiting";
import type { Session } from "../session";
import type { Seat } from "../wire";
import { Key, t } from "./words";
import { kRoles } from "./invitations";

// Somebody is away without a connection. With one, the page may still lie in a pocket.
function presence_words(s: Session, number: string, seat: Seat): string {
  if (!seat.here) return t("lead_away");
  const presence = s.presences[number];
  if (!presence) return t("lead_here");
  if (presence.hidden) return t("lead_hidden");
  const [node] = presence.holds ?? [];
  return node ? t("lead_looks_at", { what: s.nameOf(node) }) : t("lead_active");
}

// A card makes a participant a stakeholder, and an area a designer: others may not use it.
function role_with(seat: Seat, change: { card?: string; areas?: string[] }): string {
  if (seat.role !== "participant" && !seat.waits) return seat.role;
  return change.card ? "stakeholder" : (change.areas ?? []).length > 0 ? "designer" : seat.role;
}

/// Gives a role, a card or areas, and keeps the rest of what somebody has.
function set_role(s: Session, n: number, seat: Seat, change: { role?: string; card?: string; areas?: string[] }): void {
  const areas = change.areas ?? areas_of(s, n, seat);
  s.event(
    "set_role",
    { seat: n, role: change.role ?? role_with(seat, change), areas, card: change.card ?? seat.card ?? "" },
    { mark: `lead/seat${n}`, shown: areas },
  );
}

// What was ticked last stays ticked until the room has taken it.
const areas_of = (s: Session, n: number, seat: Seat): string[] =>
  (s.shown(`lead/seat${n}`, "room") as string[] | undefined) ?? seat.areas ?? [];

/// Which areas somebody may change.
function AreasOf({ s, n, seat }: { s: Session; n: number; seat: Seat }): JSX.Element | null {
  const all = Object.keys(s.views.room.areas ?? {}),
    own = areas_of(s, n, seat);
  if (all.length === 0) return null;
  const turn = (area: string): void =>
    set_role(s, n, seat, { areas: own.includes(area) ? own.filter((one) => one !== area) : [...own, area] });
  return (
    <fieldset class="field">
      <legend>{t("areas_of", { name: seat.name })}</legend>
      <div class="row">
        {all.map((area) => (
          <label key={area} class="tick">
            <input type="checkbox" checked={own.includes(area)} onChange={() => turn(area)} />
            <span>{area}</span>
          </label>
        ))}
      </div>
      {own.length > 0 && seat.role !== "designer" ? <p class="missing">{t("areas_hint")}</p> : null}
    </fieldset>
  );
}

// Who waits is let in by one press, without a look for their role.
function Door({ s }: { s: Session }): JSX.Element | null {
  const all = at_door(s);
  if (all.length === 0) return null;
  return (
    <ul class="rows door">
      {all.map(([number, seat]) => (
        <li key={number}>
          <div class="row spread">
            <Avatar name={seat.name} colour={seat.colour} />
            <span class="grow">
              <b>{seat.name}</b> <span class="faint">{t("lead_at_door")}</span>
            </span>
            <MarkState s={s} mark={`lead/seat${number}`} />
            <button
              class="quiet"
              aria-label={t("lead_let_in_name", { name: seat.name })}
              onClick={() => set_role(s, Number(number), seat, { role: "participant" })}
            >
              {t("lead_let_in")}
            </button>
          </div>
        </li>
      ))}
    </ul>
  );
}

export function People({ s }: { s: Session }): JSX.Element {
  const seats = Object.entries(s.views.room.seats ?? {}).sort((a, b) => Number(b[1].here) - Number(a[1].here));
  const cards = s.views.room.cards ?? {};
  const here = seats.filter(([, seat]) => seat.here).length;
  return (
    <section class="panel" id="lead-people" tabIndex={-1}>
      <h2>{t("lead_people")}</h2>
      <Door s={s} />
      <p>{t("lead_people_n", { n: here })}</p>
      <ul class="people">
        {seats.map(([number, seat]) => {
          const n = Number(number),
            mark = `lead/seat${n}`;
          return (
            <li key={number}>
              <details>
                <summary>
                  <Avatar name={seat.name} colour={seat.colour} />
                  <span class="grow">
                    <b>{seat.name}</b>
                    <span class="faint">
                      {seat.waits ? t("lead_at_door") : t(`role_${seat.role}` as Key)}
                      {(seat.areas ?? []).length > 0 ? ` (${(seat.areas ?? []).join(", ")})` : ""}
                      {seat.card ? ` · ${cards[seat.card]?.name ?? seat.card}` : ""} · {presence_words(s, number, seat)}
                    </span>
                  </span>
                  <MarkState s={s} mark={mark} />
                </summary>
                <div class="row">
                  <label class="field">
                    <span>{t("lead_role", { name: seat.name })}</span>
                    <select value={seat.role} onChange={(event) => set_role(s, n, seat, { role: event.currentTarget.value })}>
                      {kRoles.map((role) => (
                        <option key={role} value={role}>
                          {t(`role_${role}` as Key)}
                        </option>
                      ))}
                    </select>
                  </label>
                  {Object.keys(cards).length > 0 ? (
                    <label class="field">
                      <span>{t("lead_card", { name: seat.name })}</span>
                      <select value={seat.card ?? ""} onChange={(event) => set_role(s, n, seat, { card: event.currentTarget.value })}>
                        <option value="">{t("lead_card_none")}</option>
                        {Object.entries(cards).map(([id, card]) => (
                          <option key={id} value={id}>
                            {card.name}
                          </option>
                        ))}
                      </select>
                    </label>
                  ) : null}
                  <AreasOf s={s} n={n} seat={seat} />
                  <button class="quiet" onClick={() => s.event("mute", { seat: n, is_muted: !seat.muted }, { mark })}>
                    {t(seat.muted ? "lead_unmute" : "lead_mute")}
                  </button>
                  {n === s.you?.seat ? null : (
                    <Sure
                      text={t("lead_remove_sure", { name: seat.name })}
                      yes={t("lead_remove")}
                      onYes={() => s.event("remove_seat", { seat: n }, { mark })}
                    >
                      {t("lead_remove")}
                    </Sure>
                  )}
                </div>
              </details>
            </li>
          );
        })}
      </ul>
    </section>
  );
}
