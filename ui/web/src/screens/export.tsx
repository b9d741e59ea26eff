// The plan as a file, for facilitators and designers: formats are shown when somebody asks for them.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { t } from "../words";

/// The plan as it is now, for the programs of planners, engineers and cities. `formats` draws the choice.
export function ExportPart({ formats }: { formats(): JSX.Element }): JSX.Element {
  const [isOpen, open] = useState(false);
  return (
    <section class="panel">
      <h2>{t("export_title")}</h2>
      <p>{t("export_about")}</p>
      <details onToggle={(event) => open(event.currentTarget.open)}>
        <summary>{t("export_choose")}</summary>
        {isOpen ? formats() : null}
      </details>
    </section>
  );
}
