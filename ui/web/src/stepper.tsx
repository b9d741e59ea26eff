// One value by a slider, two buttons and a typed number.
import type { JSX } from "preact";
import { useRef, useState } from "preact/hooks";
import { amount, in_steps, number, typed_number, unit_sign } from "./format";
import { Icon } from "./parts";
import { t } from "./words";

interface StepperProps {
  id: string;
  label: string;
  value: number | null;
  minimum: number;
  maximum: number;
  step: number;
  unit: string;
  isDisabled?: boolean;
  onChange(value: number): void;
  isLive?: boolean;
}

/// A slider, two buttons and a typed number for one value: nobody has to be able to drag.
export function Stepper(props: StepperProps): JSX.Element {
  const { id, label, minimum, maximum, step, unit, isDisabled, onChange } = props;
  const [drag, setDrag] = useState<number | null>(null);
  const [typed, setTyped] = useState<string | null>(null);
  const [isWrong, setWrong] = useState(false);
  const before = useRef(""); // the text when the person came into the field
  const value = drag ?? props.value,
    text = value === null ? "" : number(value, step);
  const shown = value ?? in_steps((minimum + maximum) / 2, minimum, maximum, step);
  const put = (next: number): void => {
    setDrag(null);
    setWrong(false);
    const bounded = in_steps(next, minimum, maximum, step);
    if (bounded !== props.value) onChange(bounded);
  };
  const take = (): void => {
    if (typed === null) return;
    const read = typed_number(typed);
    setTyped(null);
    if (typed === before.current) return;
    before.current = typed;
    if (read === null || read < minimum || read > maximum) setWrong(true);
    else put(read);
  };
  const range = t("number_of", { label, least: number(minimum, step), most: number(maximum, step) });
  const filled = maximum > minimum ? ((shown - minimum) / (maximum - minimum)) * 100 : 0;
  return (
    <div class="stepper">
      <div class="typed">
        <input
          class="number"
          id={`${id}-number`}
          inputMode="decimal"
          autocomplete="off"
          enterkeyhint="done"
          disabled={isDisabled}
          aria-label={range}
          aria-invalid={isWrong}
          size={9}
          value={typed ?? text}
          onFocus={(event) => {
            // Others may change the value while somebody types: what is under the caret stays.
            before.current = text;
            setTyped(text);
            event.currentTarget.select();
          }}
          onInput={(event) => setTyped(event.currentTarget.value)}
          onBlur={take}
          onKeyDown={(event) => {
            if (event.key === "Enter") take();
            if (event.key === "Escape") setTyped(null);
          }}
        />
        <span class="unit">{unit_sign(unit)}</span>
      </div>
      <div class="slide">
        <button class="round" disabled={isDisabled || shown <= minimum} aria-label={t("less", { label })} onClick={() => put(shown - step)}>
          <Icon name="minus" />
        </button>
        <input
          type="range"
          id={id}
          min={minimum}
          max={maximum}
          step={step > 0 ? step : "any"}
          value={shown}
          disabled={isDisabled}
          aria-label={label}
          aria-valuetext={amount(shown, unit, step)}
          class={value === null ? "unset" : ""}
          style={{ "--filled": `${filled}%` }}
          onInput={(event) => {
            const next = Number(event.currentTarget.value);
            if (props.isLive) put(next);
            else setDrag(next);
          }}
          onChange={(event) => put(Number(event.currentTarget.value))}
        />
        <button class="round" disabled={isDisabled || shown >= maximum} aria-label={t("more", { label })} onClick={() => put(shown + step)}>
          <Icon name="plus" />
        </button>
      </div>
      {isWrong ? (
        <p class="wrong" role="alert">
          {range}
        </p>
      ) : null}
    </div>
  );
}
