// An area by its outline: corners by touches on the plan, or by numbers.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { amount, number, typed_number } from "../format";
import { Icon } from "../parts";
import type { Session } from "../session";
import { PlanHere } from "../space";
import type { Outline, Ui } from "../ui";
import { Corner, Drawn, crosses_itself, kLeastCorners, pins_of, size_of, touched, usual_reach, without_last } from "./corners";
import { Key, t } from "./words";

const kStep = 0.1; // of corners [m]
const kFarthest = 1e6; // of a corner from the origin [m]

function metres(text: string): number | null {
  const read = typed_number(text);
  return read !== null && Math.abs(read) <= kFarthest ? read : null;
}

// What is no number yet stays as it was typed, and changes nothing.
function Metres({ label, value, set }: { label: string; value: number; set(value: number): void }): JSX.Element {
  const [typed, type] = useState<string | null>(null),
    isWrong = typed !== null && metres(typed) === null;
  return (
    <input
      class="number"
      inputMode="decimal"
      autocomplete="off"
      aria-label={label}
      aria-invalid={isWrong}
      value={typed ?? number(value, kStep)}
      onInput={(event) => {
        type(event.currentTarget.value);
        const read = metres(event.currentTarget.value);
        if (read !== null) set(read);
      }}
      onBlur={() => type(null)}
    />
  );
}

function Numbers({ corners, change }: { corners: Corner[]; change(corners: Corner[]): void }): JSX.Element {
  const [x, setX] = useState(""),
    [y, setY] = useState("");
  const fresh: [number | null, number | null] = [metres(x), metres(y)];
  const add = (): void => {
    if (fresh[0] === null || fresh[1] === null) return;
    change([...corners, [fresh[0], fresh[1]]]);
    setX("");
    setY("");
  };
  const put = (i: number, corner: Corner): void => change(corners.map((one, k) => (k === i ? corner : one)));
  return (
    <details class="numbers">
      <summary>{t("outline_numbers")}</summary>
      <ol class="corners">
        {corners.length === 0 ? null : (
          <li aria-hidden="true">
            <i />
            <span>x [m]</span>
            <span>y [m]</span>
          </li>
        )}
        {corners.map(([u, v], i) => (
          <li key={i}>
            <b>{number(i + 1)}</b>
            <Metres label={t("outline_x", { n: i + 1 })} value={u} set={(value) => put(i, [value, v])} />
            <Metres label={t("outline_y", { n: i + 1 })} value={v} set={(value) => put(i, [u, value])} />
            <button class="round" aria-label={t("outline_remove", { n: i + 1 })} onClick={() => change(corners.filter((_, k) => k !== i))}>
              <Icon name="cross" />
            </button>
          </li>
        ))}
      </ol>
      <div class="pair">
        {(["x", "y"] as const).map((axis) => (
          <label key={axis} class="field">
            <span>{t(`outline_new_${axis}` as Key)}</span>
            <input
              class="number"
              inputMode="decimal"
              autocomplete="off"
              aria-invalid={(axis === "x" ? x : y) !== "" && fresh[axis === "x" ? 0 : 1] === null}
              value={axis === "x" ? x : y}
              onInput={(event) => (axis === "x" ? setX : setY)(event.currentTarget.value)}
            />
          </label>
        ))}
      </div>
      <button class="quiet" disabled={fresh.includes(null)} onClick={add}>
        {t("outline_add")}
      </button>
    </details>
  );
}

/// The outlines that areas have already.
export const outlines_of = (s: Session): Outline[] =>
  Object.entries(s.views.lead.areas ?? {}).flatMap(([name, { outline }]) =>
    outline && outline.length > 0 ? [{ id: `area/${name}`, corners: outline, name }] : [],
  );

export function OutlineField({ s, ui, drawn, set }: { s: Session; ui: Ui; drawn: Drawn; set(drawn: Drawn): void }): JSX.Element {
  const { corners, isClosed } = drawn,
    n = corners.length,
    isEnough = n >= kLeastCorners;
  const own: Outline = { id: "new", corners, name: "", isOpen: !isClosed };
  const said =
    n === 0
      ? t("outline_how")
      : !isEnough
        ? t("outline_few", { n })
        : isClosed
          ? t("outline_closed", { n, size: amount(size_of(corners), "m²", 1) })
          : t("outline_open", { n });
  return (
    <fieldset class="field">
      <legend>{t("area_by_outline")}</legend>
      <p role="status">{said}</p>
      <PlanHere
        s={s}
        ui={ui}
        binding={{
          pins: pins_of(corners),
          outlines: [...outlines_of(s), ...(n > 1 ? [own] : [])],
          onTap: ([x, y], _, reach) => set(touched(drawn, [x, y], reach ?? usual_reach(corners))),
        }}
      />
      <div class="row">
        <button class="quiet" disabled={!isEnough || isClosed} onClick={() => set({ corners, isClosed: true })}>
          <Icon name="check" />
          {t("outline_close")}
        </button>
        <button class="quiet" disabled={n === 0} onClick={() => set(without_last(drawn))}>
          <Icon name="undo" />
          {t(isClosed ? "outline_reopen" : "outline_undo")}
        </button>
      </div>
      <p class="missing" role="status">{crosses_itself(drawn) ? t("outline_crosses") : ""}</p>
      <Numbers corners={corners} change={(next) => set({ corners: next, isClosed: isClosed && next.length >= kLeastCorners })} />
    </fieldset>
  );
}
