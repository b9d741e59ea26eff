// A visitor adds something new: what it is, where it should stand, and how large it is.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { amount, typed_number } from "../format";
import { Icon, MarkState, Title } from "../parts";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Ui } from "../ui";
import { t } from "../words";

/// Volumes that people know [m³].
const kSizes = [
  { key: "form_small", volume: 100 },
  { key: "form_medium", volume: 1000 },
  { key: "form_large", volume: 8000 },
] as const;

export function Form({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const [name, setName] = useState(""),
    [size, setSize] = useState("");
  const volume = typed_number(size),
    place = ui.place,
    range = s.views.room.forms?.smart_volume?.demand;
  const isOut = volume !== null && range !== undefined && (volume < range.minimum || volume > range.maximum);
  const missing = [
    name.trim() === "" ? t("form_needs_name") : "",
    place === null ? t("form_needs_place") : "",
    volume === null || volume <= 0 || isOut ? t("form_needs_size") : "",
  ].filter(Boolean);
  const send = (): void => {
    if (!place || volume === null) return;
    // A cube of this volume that stands on the ground has its middle at half its height.
    const position = [place[0], place[1], Math.round(Math.cbrt(volume) * 5) / 10];
    s.command(
      "add_node",
      { id: s.freshName("smart_volume"), node: { name: name.trim(), position, types: { smart_volume: { demand: volume } } } },
      { mark: "form/new", shown: name.trim() },
    );
    setName("");
    setSize("");
    ui.set({ place: null });
  };
  const state = s.mark("form/new")?.state;
  return (
    <>
      <Title>{t("form_title")}</Title>
      <label class="field">
        <span>{t("form_name")}</span>
        <input value={name} maxLength={40} autocomplete="off" onInput={(event) => setName(event.currentTarget.value)} />
      </label>
      <p class="how">{t("form_place")}</p>
      <PlanHere
        s={s}
        ui={ui}
        binding={{
          pins: place ? [{ id: "new", x: place[0], y: place[1], letter: "+", tone: "mine", label: name }] : [],
          onTap: (at) => ui.set({ place: at, selected: null }),
        }}
      />
      <fieldset class="field">
        <legend>{t("form_size")}</legend>
        <div class="sizes">
          {kSizes
            .filter((one) => !range || (one.volume >= range.minimum && one.volume <= range.maximum))
            .map((one) => (
              <button key={one.key} class="choice" aria-pressed={volume === one.volume} onClick={() => setSize(String(one.volume))}>
                {t(one.key)}
              </button>
            ))}
        </div>
        <label class="field inline">
          <span>{t("form_volume")}</span>
          <input
            class="number"
            inputMode="decimal"
            autocomplete="off"
            value={size}
            aria-invalid={isOut}
            onInput={(event) => setSize(event.currentTarget.value)}
          />
        </label>
        {range ? (
          <p class={isOut ? "wrong" : "small"}>
            {t("form_range", { least: amount(range.minimum, range.unit), most: amount(range.maximum, range.unit) })}
          </p>
        ) : null}
      </fieldset>
      {missing.length > 0 && (name || size || place) ? (
        <p class="missing" aria-live="polite">
          {t("form_needs", { what: missing.join(", ") })}
        </p>
      ) : null}
      {state === "saved" ? (
        <p class="counted" role="status">
          <Icon name="check" />
          {t("form_sent")}
        </p>
      ) : (
        <MarkState s={s} mark="form/new" />
      )}
      <button class="main" disabled={missing.length > 0} onClick={send}>
        <Icon name="plus" />
        {t("form_send")}
      </button>
    </>
  );
}
