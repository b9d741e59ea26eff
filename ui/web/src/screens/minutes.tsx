// After the session: how the minutes are made, with the session file of this room.
import type { JSX } from "preact";
import { minutes_of } from "../minutes";
import type { Session } from "../session";
import { t } from "../words";
import { AddressRow } from "./invitations";

export function MinutesPart({ s }: { s: Session }): JSX.Element {
  const { command, page } = minutes_of(s.health?.file || "FILE.blsession");
  return (
    <section class="panel">
      <h2>{t("minutes_title")}</h2>
      <p>{t("minutes_make")}</p>
      <AddressRow name={t("minutes_command")} address={command} />
      <p>{t("minutes_open")}</p>
      <AddressRow name={t("minutes_page")} address={page} />
    </section>
  );
}
