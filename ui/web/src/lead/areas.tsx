// The areas of a room, for the facilitator: what lies in each, who has it, and how a new one is made.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { area_name, area_words } from "./area_words";
import { MarkState, Segments, Sure } from "../parts";
import { writers_of } from "../pens";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Ui } from "../ui";
import type { Json } from "../wire";
import { Drawn, crosses_itself, kLeastCorners, size_of } from "./corners";
import { OutlineField } from "./outline";
import { t } from "./words";

type By = "tag" | "role" | "things" | "outline";
const kNothing: Drawn = { corners: [], isClosed: false };

// Who changes the area, and who would like to.
function PenOf({ s, area }: { s: Session; area: string }): JSX.Element {
  const { pen, asking } = s.views.room.areas?.[area] ?? { pen: 0, asking: [] },
    others = writers_of(s, area).filter((seat) => seat !== pen && !asking.includes(seat));
  const give = (seat: number): void => s.event("give_pen", { area, seat }, { mark: `lead/area/${area}` });
  return (
    <>
      <p class="small">
        {pen === 0 ? t("pen_nobody") : t("pen_of", { name: s.seatName(pen) })}
        {asking.map((seat) => ` ${t("pen_asked", { name: s.seatName(seat) })}`)}
      </p>
      <div class="row">
        {asking.map((seat) => (
          <button key={seat} class="quiet" onClick={() => give(seat)}>
            {t("pen_give", { name: s.seatName(seat) })}
          </button>
        ))}
        {pen === 0 ? null : (
          <button class="quiet" onClick={() => give(0)}>
            {t("area_pen_take")}
          </button>
        )}
      </div>
      {others.length > 0 ? (
        <label class="field">
          <span>{t("area_pen_to", { area })}</span>
          <select value="" onChange={(event) => event.currentTarget.value !== "" && give(Number(event.currentTarget.value))}>
            <option value="">{t("area_choose")}</option>
            {others.map((seat) => (
              <option key={seat} value={seat}>
                {s.seatName(seat)}
              </option>
            ))}
          </select>
        </label>
      ) : null}
    </>
  );
}

function AreaRow({ s, area }: { s: Session; area: string }): JSX.Element {
  const { areas, roles } = s.views.lead;
  const who = Object.values(s.views.room.seats ?? {})
    .filter((seat) => seat.areas?.includes(area))
    .map((seat) => seat.name);
  const content = areas?.[area];
  return (
    <li>
      <div class="row spread">
        <b class="grow">{area}</b>
        <MarkState s={s} mark={`lead/area/${area}`} />
      </div>
      {content ? <p>{area_words(content, roles, (node) => s.nameOf(node))}</p> : null}
      <p class="small">{who.length > 0 ? t("area_who", { names: who.join(", ") }) : t("area_nobody")}</p>
      <PenOf s={s} area={area} />
      <Sure
        text={t("area_drop_sure", { area })}
        yes={t("area_drop")}
        onYes={() => s.event("drop_area", { area }, { mark: `lead/area/${area}` })}
      >
        {t("area_drop")}
      </Sure>
    </li>
  );
}

// Volumes and whatever else stands on the plan as a node of the scene; what has no node of its own has a slash in its key.
const things_of = (s: Session): [string, string][] =>
  s
    .plan()
    .filter(([id]) => !id.includes("/"))
    .map(([id, item]): [string, string] => [id, item.name || id])
    .sort((a, b) => a[1].localeCompare(b[1]));

function Things({ s, ui, chosen, choose }: { s: Session; ui: Ui; chosen: string[]; choose(node: string): void }): JSX.Element {
  const all = things_of(s);
  return (
    <fieldset class="field">
      <legend>{t("area_things")}</legend>
      <PlanHere
        s={s}
        ui={ui}
        binding={{ pins: [], onTap: (_, node) => node !== null && all.some(([id]) => id === node) && choose(node) }}
      />
      <div class="row things">
        {all.map(([id, name]) => (
          <label key={id} class="tick">
            <input type="checkbox" checked={chosen.includes(id)} onChange={() => choose(id)} />
            <span>{name}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

function Choice({ label, all, value, set }: { label: string; all: [string, string][]; value: string; set(id: string): void }): JSX.Element {
  return (
    <label class="field">
      <span>{label}</span>
      <select value={value} onChange={(event) => set(event.currentTarget.value)}>
        <option value="">{t("area_choose")}</option>
        {all.map(([id, name]) => (
          <option key={id} value={id}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

function NewArea({ s, ui, taken }: { s: Session; ui: Ui; taken: string[] }): JSX.Element {
  const { tags = {}, roles = {} } = s.views.lead;
  const [typed, type] = useState(""),
    [by, go] = useState<By>(Object.keys(tags).length > 0 ? "tag" : "things"),
    [tag, setTag] = useState(""),
    [role, setRole] = useState(""),
    [things, setThings] = useState<string[]>([]),
    [drawn, draw] = useState(kNothing);
  // Who chooses a tag need not think of a name.
  const area = area_name(typed.trim() === "" && by === "tag" ? tag : typed, taken);
  const isDrawn = drawn.corners.length >= kLeastCorners && size_of(drawn.corners) > 0 && !crosses_itself({ ...drawn, isClosed: true });
  const contents: Record<By, Record<string, Json> | null> = {
    tag: tag === "" ? null : { nodes: { tag } },
    role: role === "" ? null : { nodes: { typification: role } },
    things: things.length === 0 ? null : { nodes: things },
    outline: isDrawn ? { outline: drawn.corners.map(([x, y]) => [x, y, 0]) } : null,
  };
  const content = contents[by];
  const make = (): void => {
    s.event("define_area", { area, ...content }, { mark: "lead/area" });
    type("");
    setTag("");
    setRole("");
    setThings([]);
    draw(kNothing);
  };
  const choose = (node: string): void => setThings(things.includes(node) ? things.filter((one) => one !== node) : [...things, node]);
  return (
    <section>
      <Segments
        label={t("area_by")}
        value={by}
        onChange={(one) => go(one)}
        choices={[
          { id: "tag", text: t("area_by_tag") },
          { id: "role", text: t("area_by_role") },
          { id: "things", text: t("area_by_things") },
          { id: "outline", text: t("area_by_outline") },
        ]}
      />
      {by === "tag" ? (
        <Choice
          label={t("area_by_tag")}
          all={Object.entries(tags).map(([id, n]) => [id, t("area_counted", { name: id, n })])}
          value={tag}
          set={setTag}
        />
      ) : by === "role" ? (
        <Choice
          label={t("area_by_role")}
          all={Object.entries(roles).map(([id, { label, count }]) => [id, t("area_counted", { name: label, n: count })])}
          value={role}
          set={setRole}
        />
      ) : by === "outline" ? (
        <OutlineField s={s} ui={ui} drawn={drawn} set={draw} />
      ) : (
        <Things s={s} ui={ui} chosen={things} choose={choose} />
      )}
      <label class="field">
        <span>{t("area_name")}</span>
        <input value={typed} maxLength={40} autocomplete="off" onInput={(event) => type(event.currentTarget.value)} />
      </label>
      {area !== "" && area !== typed.trim() ? <p class="small">{t("area_id", { area })}</p> : null}
      <div class="row">
        <button class="quiet" disabled={area === "" || content === null} onClick={make}>
          {t(taken.includes(area) ? "area_change" : "area_make")}
        </button>
        <MarkState s={s} mark="lead/area" />
      </div>
    </section>
  );
}

export function AreasPart({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const all = Object.keys(s.views.room.areas ?? {}),
    [isMaking, make] = useState(false);
  return (
    <section class="panel" id="lead-areas" tabIndex={-1}>
      <h2>{t("areas")}</h2>
      <p class="small">{t("areas_text")}</p>
      {all.length > 0 ? (
        <ul class="rows">
          {all.map((area) => (
            <AreaRow key={area} s={s} area={area} />
          ))}
        </ul>
      ) : (
        <p>{t("areas_none")}</p>
      )}
      <details onToggle={(event) => make(event.currentTarget.open)}>
        <summary>{t("area_new")}</summary>
        {isMaking ? <NewArea s={s} ui={ui} taken={all} /> : null}
      </details>
    </section>
  );
}
