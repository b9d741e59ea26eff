// After the session: its minutes, to open and to save.
import type { JSX } from "preact";
import { minutes_of } from "../minutes";
import { OpenMinutes } from "../screens/open_minutes";
import type { Session } from "../session";
import { t } from "./words";
import { AddressRow } from "./invitations";
import { MinutesFiles } from "./minutes_files";

export function MinutesPart({ s }: { s: Session }): JSX.Element {
  const { command, page } = minutes_of(s.health?.file || "FILE.blsession"),
    room = s.views.room.code ?? "",
    token = s.connection.token ?? "";
  return (
    <section class="panel">
      <h2>{t("minutes_title")}</h2>
      <p>{t("minutes_about")}</p>
      <OpenMinutes s={s}>{t("minutes_open")}</OpenMinutes>
      <h3>{t("minutes_save")}</h3>
      <MinutesFiles room={room} token={token} />
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
