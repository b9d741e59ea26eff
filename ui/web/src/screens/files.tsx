// Files to save, for facilitators and designers: the script that asks for them comes when it is needed.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { script } from "../chunks";
import type { Session } from "../session";
import { t } from "../words";

/// One part of that script.
export function Part({ s, what }: { s: Session; what: "minutes" | "plan" }): JSX.Element {
  const box = useRef<HTMLDivElement>(null),
    [isLost, lose] = useState(false);
  useEffect(() => {
    script("files").then(
      ({ show }) => box.current && show(what, box.current, { room: s.views.room.code ?? "", token: s.connection.token ?? "", t }),
      () => lose(true),
    );
  }, []);
  return isLost ? <p class="notice">{t("files_offline")}</p> : <div ref={box} />;
}

/// The plan as it is now, for the programs of planners, engineers and cities.
export function ExportPart({ s }: { s: Session }): JSX.Element {
  const [isOpen, open] = useState(false);
  return (
    <section class="panel">
      <h2>{t("export_title")}</h2>
      <p>{t("export_about")}</p>
      <details onToggle={(event) => open(event.currentTarget.open)}>
        <summary>{t("export_choose")}</summary>
        {isOpen ? <Part s={s} what="plan" /> : null}
      </details>
    </section>
  );
}
