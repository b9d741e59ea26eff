// The pens of one's own areas: who has them, and what one can do about it.
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { MarkState } from "../parts";
import { own_pens, tab_of_pens } from "../pens";
import type { Session } from "../session";
import type { Ui } from "../ui";
import { t } from "../words";

function PenRow({ s, area }: { s: Session; area: string }): JSX.Element {
  const { pen, asking } = s.views.room.areas?.[area] ?? { pen: 0, asking: [] },
    me = s.you?.seat ?? 0,
    mark = `pen/${area}`;
  const give = (seat: number): void => s.event("give_pen", { area, seat }, { mark });
  const ask = (asks: boolean): void => s.event("ask_pen", { area, asks }, { mark });
  const holder = pen === 0 ? t("pen_nobody") : pen === me ? t("pen_yours") : t("pen_of", { name: s.seatName(pen) });
  return (
    <li>
      <div class="row spread">
        <b class="grow">{area}</b>
        <MarkState s={s} mark={mark} />
      </div>
      <p role="status">
        {holder}
        {pen === me && asking.length > 0 ? ` ${t("pen_asked", { name: s.seatName(asking[0] ?? 0) })}` : ""}
        {asking.includes(me) ? ` ${t("pen_you_asked")}` : ""}
      </p>
      <div class="row">
        {pen === me ? (
          <>
            {asking.map((seat) => (
              <button key={seat} class="quiet" onClick={() => give(seat)}>
                {t("pen_give", { name: s.seatName(seat) })}
              </button>
            ))}
            {asking.length > 0 ? (
              <button class="quiet" onClick={() => give(me)}>
                {t("pen_keep")}
              </button>
            ) : null}
            <button class="quiet" onClick={() => give(0)}>
              {t("pen_lay_down")}
            </button>
          </>
        ) : asking.includes(me) ? (
          <button class="quiet" onClick={() => ask(false)}>
            {t("pen_ask_not")}
          </button>
        ) : (
          <button class="quiet" onClick={() => ask(true)}>
            {t(pen === 0 ? "pen_take" : "pen_ask")}
          </button>
        )}
      </div>
    </li>
  );
}

/// On the screen `on`, where that is the one for this person.
export function Pens({ s, ui, on }: { s: Session; ui: Ui; on: "plan" | "card" }): JSX.Element | null {
  const box = useRef<HTMLElement>(null),
    areas = own_pens(s);
  // Somebody was led here.
  useEffect(() => {
    if (!ui.isToPens || !box.current) return;
    ui.isToPens = false;
    box.current.scrollIntoView({ block: "start" });
    box.current.focus({ preventScroll: true });
  });
  if (areas.length === 0 || tab_of_pens(s) !== on) return null;
  return (
    <section class="panel" id="pens" ref={box} tabIndex={-1}>
      <h2>{t("pens")}</h2>
      <p class="small">{t("pens_text")}</p>
      <ul class="rows">
        {areas.map((area) => (
          <PenRow key={area} s={s} area={area} />
        ))}
      </ul>
    </section>
  );
}
