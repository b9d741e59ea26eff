// After the session: its minutes, to open and to save.
import type { JSX } from "preact";
import { kMinutes, minutes_form, minutes_of, zone_here } from "../minutes";
import { Icon } from "../parts";
import type { Session } from "../session";
import { t } from "../words";
import { Part } from "./files";
import { AddressRow } from "./invitations";

// A page of its own, which the browser asks for as for any form. It is not taken from memory, because the policy of this page would
// forbid its style.
function OpenMinutes({ room, token }: { room: string; token: string }): JSX.Element {
  return (
    <form method="post" action="/minutes" target="_blank">
      {Object.entries(minutes_form(room, token, kMinutes.page, zone_here())).map(([name, value]) => (
        <input key={name} type="hidden" name={name} value={value} />
      ))}
      <button class="main">
        {t("minutes_open")}
        <Icon name="right" />
      </button>
    </form>
  );
}

export function MinutesPart({ s }: { s: Session }): JSX.Element {
  const { command, page } = minutes_of(s.health?.file || "FILE.blsession"),
    room = s.views.room.code ?? "",
    token = s.connection.token ?? "";
  return (
    <section class="panel">
      <h2>{t("minutes_title")}</h2>
      <p>{t("minutes_about")}</p>
      <OpenMinutes room={room} token={token} />
      <h3>{t("minutes_save")}</h3>
      <Part s={s} what="minutes" />
      <details>
        <summary>{t("minutes_by_command")}</summary>
        <p>{t("minutes_make")}</p>
        <AddressRow name={t("minutes_command")} address={command} />
        <p>{t("minutes_then")}</p>
        <AddressRow name={t("minutes_page")} address={page} />
      </details>
    </section>
  );
}
