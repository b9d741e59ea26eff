// The plan in the formats of other programs: a choice of formats with their options, and a file to save.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { Format, FormatOption, export_form, formats_of_server, option_name, option_text, saved_as } from "./asking";
import { Props, SaidOfFile, ask, useFile } from "./saving";
import { t } from "./words";

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

export function PlanFiles({ room, token }: Props): JSX.Element {
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
  const format = formats?.find((one) => one.id === chosen) ?? formats?.[0];
  const of_format = format ? wanted[format.id] ?? {} : {};
  return (
    <div class="stack">
      {formats && formats.length === 0 ? (
        <p class="notice" role="status">
          {t("files_offline")}{" "}
          <button class="quiet" onClick={() => ask_again(isAsked + 1)}>
            {t("try_again")}
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
              <div class="stack">
                {format.options.map((option) => (
                  <OptionField
                    key={`${format.id}/${option.id}`}
                    option={option}
                    value={of_format[option.id] ?? option_text(option.default)}
                    onChange={(value) => want({ ...wanted, [format.id]: { ...of_format, [option.id]: value } })}
                  />
                ))}
              </div>
            </details>
          ) : null}
          <button
            class="main"
            aria-disabled={said?.state === "making"}
            onClick={() => void get(export_form(room, token, format, of_format), saved_as(room, `plan${format.ending}`))}
          >
            {t("export_save")}
          </button>
          <SaidOfFile said={said} />
        </>
      ) : null}
    </div>
  );
}
