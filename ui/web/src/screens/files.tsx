// Files to save: how one is asked for and told of, and the plan in the formats of other programs.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { Format, FormatOption, export_form, file_from_server, formats_of_server, option_name, option_text, saved_as } from "../files";
import type { Session } from "../session";
import { t } from "../words";

const ask: typeof fetch = (...what) => window.fetch(...what);

function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Some browsers begin to read only after the click.
  window.setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

interface Said {
  state: "making" | "saved" | "failed";
  text: string;
  notes: string[];
}

/// Asks for one file at a time, saves it, and says how that went.
export function useFile(what: "minutes" | "export"): { said: Said | null; get(form: Record<string, string>, name: string): Promise<void> } {
  const [said, say] = useState<Said | null>(null);
  const get = async (form: Record<string, string>, name: string): Promise<void> => {
    if (said?.state === "making") return;
    say({ state: "making", text: t("files_making"), notes: [] });
    const got = await file_from_server(what, form, ask);
    if (!("blob" in got)) return say({ state: "failed", text: t(got.why, { why: got.text }), notes: [] });
    save(got.blob, name);
    say({ state: "saved", text: t("files_saved", { file: name }), notes: got.notes });
  };
  return { said, get };
}

export function SaidOfFile({ said }: { said: Said | null }): JSX.Element {
  return (
    <div role="status">
      <p class={said?.state === "failed" ? "notice" : "small"}>{said?.text ?? ""}</p>
      {said && said.notes.length > 0 ? (
        <ul class="small">
          {said.notes.map((note) => (
            <li key={note}>{note}</li>
          ))}
        </ul>
      ) : null}
    </div>
  );
}

function OptionField({ option, value, onChange }: { option: FormatOption; value: string; onChange(value: string): void }): JSX.Element {
  const name = option_name(option.id) + (option.unit ? ` (${option.unit})` : "");
  if (option.kind === "boolean")
    return (
      <label class="tick" title={option.doc}>
        <input type="checkbox" checked={value === "yes"} onChange={(event) => onChange(event.currentTarget.checked ? "yes" : "no")} />
        <span>{name}</span>
      </label>
    );
  return (
    <label class="field" title={option.doc}>
      <span>{name}</span>
      {option.kind === "choice" ? (
        <select value={value} onChange={(event) => onChange(event.currentTarget.value)}>
          {(option.choices ?? []).map((choice) => (
            <option key={choice.id} value={choice.id} title={choice.doc}>
              {option_name(choice.id)}
            </option>
          ))}
        </select>
      ) : (
        <input
          class={option.kind === "text" ? undefined : "number"}
          inputMode={option.kind === "text" ? "text" : "decimal"}
          autocomplete="off"
          value={value}
          onInput={(event) => onChange(event.currentTarget.value)}
        />
      )}
    </label>
  );
}

/// The plan as it is now, for the programs of planners, engineers and cities.
export function ExportPart({ s }: { s: Session }): JSX.Element {
  const [formats, know] = useState<Format[] | null>(null),
    [isAsked, ask_again] = useState(0),
    [chosen, choose] = useState("pdf"),
    [wanted, want] = useState<Record<string, Record<string, string>>>({}),
    { said, get } = useFile("export");
  useEffect(() => {
    let isHere = true;
    void formats_of_server(ask).then((all) => isHere && know(all ?? []));
    return () => {
      isHere = false;
    };
  }, [isAsked]);
  const format = formats?.find((one) => one.id === chosen) ?? formats?.[0],
    room = s.views.room.code ?? "";
  const of_format = format ? wanted[format.id] ?? {} : {};
  return (
    <section class="panel">
      <h2>{t("export_title")}</h2>
      <p>{t("export_about")}</p>
      {formats && formats.length === 0 ? (
        <p class="notice" role="status">
          {t("files_offline")}{" "}
          <button class="quiet" onClick={() => ask_again(isAsked + 1)}>
            {t("export_again")}
          </button>
        </p>
      ) : null}
      {format && formats ? (
        <>
          <label class="field">
            <span>{t("export_format")}</span>
            <select value={format.id} onChange={(event) => choose(event.currentTarget.value)}>
              {formats.map((one) => (
                <option key={one.id} value={one.id}>
                  {`${one.label} (${one.ending})`}
                </option>
              ))}
            </select>
          </label>
          <p class="small">{format.doc}</p>
          {format.options.length > 0 ? (
            <details>
              <summary>{t("export_options")}</summary>
              {format.options.map((option) => (
                <OptionField
                  key={`${format.id}/${option.id}`}
                  option={option}
                  value={of_format[option.id] ?? option_text(option.default)}
                  onChange={(value) => want({ ...wanted, [format.id]: { ...of_format, [option.id]: value } })}
                />
              ))}
            </details>
          ) : null}
          <button
            class="main"
            aria-disabled={said?.state === "making"}
            onClick={() => void get(export_form(room, s.connection.token ?? "", format, of_format), saved_as(room, `plan${format.ending}`))}
          >
            {t("export_save")}
          </button>
          <SaidOfFile said={said} />
        </>
      ) : null}
    </section>
  );
}
