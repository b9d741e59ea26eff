// The plan, or the picture in three dimensions in its place: a button chooses. The picture's script comes when it is asked for.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { script } from "./chunks";
import { Plan, PlanProps } from "./plan";
import type { Session } from "./session";
import type { Look, Mark, Picture, Step } from "./space/picture";
import type { SpaceContent } from "./space/contents";
import { Buttons, North, kKeys, looks_of } from "./space_controls";
import { Binding, Ui, is_of_browser, useBinding, useMedia, useWide } from "./ui";
import { t } from "./words";

type Stage = "loading" | "ready" | "no_script" | "no_webgl";

/// What the plan says of each thing, by node.
function names_of(s: Session): Map<string, Look> {
  return new Map(s.plan().map(([id, { kind, fill, name }]) => [id, { kind, fill, name }]));
}

function Space({ s, binding, selected, isStill, label }: PlanProps): JSX.Element {
  const box = useRef<HTMLDivElement>(null),
    canvas = useRef<HTMLCanvasElement>(null),
    overlay = useRef<HTMLDivElement>(null),
    north = useRef<SVGGElement | null>(null),
    picture = useRef<Picture | null>(null);
  const [stage, setStage] = useState<Stage>("loading"),
    [attempt, again] = useState(0),
    [isMoving, setMoving] = useState(false);
  const isDark = useMedia("(prefers-color-scheme: dark)"),
    isCalm = useMedia("(prefers-reduced-motion: reduce)");
  const space = s.views.shapes.space as unknown as SpaceContent | undefined;
  const latest = useRef({ binding, space });
  latest.current = { binding, space };

  useEffect(() => {
    s.want("shapes");
    return () => s.release("shapes");
  }, []);
  useEffect(() => {
    let isGone = false;
    setStage("loading");
    script("space").then(
      ({ Picture: Made }) => {
        if (isGone || !canvas.current || !overlay.current || !box.current) return;
        try {
          picture.current = new Made({
            canvas: canvas.current,
            overlay: overlay.current,
            looks: looks_of(box.current, isDark),
            isCalm,
            onTap: (place, node) => latest.current.binding?.onTap(place, node),
            onLook: (azimuth) => {
              // The y axis and true north differ by what the scene says.
              const turn = -azimuth * (180 / Math.PI) + (latest.current.space?.true_north ?? 0);
              north.current?.setAttribute("transform", `rotate(${turn.toFixed(1)})`);
            },
          });
          setStage("ready");
        } catch {
          setStage("no_webgl");
        }
      },
      () => isGone || setStage("no_script"),
    );
    return () => {
      isGone = true;
      picture.current?.dispose();
      picture.current = null;
    };
  }, [attempt, isDark, isCalm]);
  useEffect(() => {
    const marks: Mark[] = (binding?.pins ?? []).map(({ x, y, letter, tone }) => ({ place: [x, y, 0], letter, tone }));
    if (picture.current) picture.current.isMoving = isMoving;
    picture.current?.show(s.views.shapes, names_of(s), marks, selected);
  });

  const step = (what: Step): void => picture.current?.step(what);
  const keys = (event: KeyboardEvent): void => {
    const what = is_of_browser(event) ? undefined : kKeys[event.key];
    if (!what) return;
    step(what);
    event.preventDefault();
  };
  const n = s.plan().filter(([, item]) => item.kind === "volume" || item.kind === "building").length;
  const isReady = stage === "ready" && space !== undefined;
  const said =
    stage === "no_webgl" ? t("space_no_webgl") : stage === "no_script" ? t("space_no_script") : isReady ? null : t("space_loading");
  return (
    <>
    <div class={`plan space ${isStill ? "still" : ""}`} ref={box} onKeyDown={isStill ? undefined : keys}>
      {/* A canvas whose WebGL was given back does not give another. */}
      <canvas key={`${attempt} ${isDark} ${isCalm}`} ref={canvas} role="img" aria-label={t("space_of", { n })} />
      <div class="names" ref={overlay} aria-hidden="true" style={isStill && label ? { fontSize: `${label}px` } : {}} />
      {said === null ? null : (
        <div class="said" role="status">
          <p>{said}</p>
          {stage === "no_script" ? (
            <button class="quiet" onClick={() => again((count) => count + 1)}>
              {t("reload")}
            </button>
          ) : null}
        </div>
      )}
      {isReady ? <North turned={north} /> : null}
      {isReady && !isStill ? <Buttons step={step} isMoving={isMoving} setMoving={setMoving} /> : null}
    </div>
      {isReady && (space?.is_coarse || (space?.left_out ?? 0) > 0) ? (
        <p class="remark small">
          {space?.is_coarse ? `${t("space_coarse")} ` : ""}
          {(space?.left_out ?? 0) > 0 ? t("space_left_out", { n: space?.left_out ?? 0 }) : ""}
        </p>
      ) : null}
    </>
  );
}

/// Where a plan is shown that can also be seen in three dimensions. The choice stays as long as the page.
let isChosen = false;

export function PlanOrSpace(props: PlanProps): JSX.Element {
  const [isSpace, set] = useState(isChosen);
  const choose = (): void => {
    isChosen = !isSpace;
    set(isChosen);
  };
  return (
    <div class={`seen ${props.isStill ? "still" : ""}`}>
      {isSpace ? <Space {...props} /> : <Plan {...props} />}
      <button
        class="switch"
        aria-pressed={isSpace}
        onClick={choose}
        style={props.isStill && props.label ? { fontSize: `${props.label}px` } : {}}
      >
        {t("view_3d")}
      </button>
    </div>
  );
}

/// The picture where nobody has chosen it here: on the beamer, as the facilitator wishes.
export function SpaceAlone(props: PlanProps): JSX.Element {
  return (
    <div class={`seen ${props.isStill ? "still" : ""}`}>
      <Space {...props} />
    </div>
  );
}

/// The plan where the screen has room for it: inside a narrow screen, beside a wide one.
export function PlanHere({ s, ui, binding }: { s: Session; ui: Ui; binding: Binding }): JSX.Element | null {
  const isWide = useWide();
  useBinding(ui, isWide ? binding : null);
  return isWide ? null : <PlanOrSpace s={s} binding={binding} selected={ui.selected} />;
}
