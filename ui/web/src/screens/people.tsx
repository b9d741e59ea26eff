// The people of a room, for the facilitator: roles, cards, mute, remove.
import type { JSX } from "preact";
import { Avatar, MarkState, Sure } from "../parts";
import type { Session } from "../session";
import type { Seat } from "../wire";
import { Key, t } from "../words";
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

/// Gives a role, and keeps the card and the areas that somebody has.
function set_role(s: Session, n: number, seat: Seat, change: { role?: string; card?: string }): void {
  // A card makes a participant a stakeholder: others may not use its values.
  const role = change.role ?? (change.card && seat.role === "participant" ? "stakeholder" : seat.role);
  s.event("set_role", { seat: n, role, areas: seat.areas ?? [], card: change.card ?? seat.card ?? "" }, { mark: `lead/seat${n}` });
}

export function People({ s }: { s: Session }): JSX.Element {
  const seats = Object.entries(s.views.room.seats ?? {}).sort((a, b) => Number(b[1].here) - Number(a[1].here));
  const cards = s.views.room.cards ?? {};
  const here = seats.filter(([, seat]) => seat.here).length;
  return (
    <section class="panel">
      <h2>{t("lead_people")}</h2>
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
                      {t(`role_${seat.role}` as Key)}
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
