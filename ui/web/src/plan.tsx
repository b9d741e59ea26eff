// The plan: outlines that people move and enlarge by fingers, wheel, keys or buttons, and touch to ask what they are.
import type { ComponentChildren, JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { middle_of } from "./outline";
import { Icon } from "./parts";
import { Frame, Name, extent, names_of } from "./plan_names";
import type { Session } from "./session";
import { Binding, Outline, Pin, is_of_browser } from "./ui";
import type { PlanItem } from "./wire";
import { t } from "./words";

const kMost = 12,
  kTap = 10,
  kNear = 14,
  kReach = 22, // of a target, around its middle
  kLongTap = 600,
  kMargin = 0.03;
const kOrder = ["boundary", "plot", "street", "building", "volume"];

// The outlines come with y downwards. The box is of the same outlines, but the contract may mean it either way up; the outlines
// themselves are what has to fit.
function whole(items: [string, PlanItem][]): Frame {
  let left = Infinity,
    right = -Infinity,
    top = Infinity,
    bottom = -Infinity;
  for (const [, item] of items) {
    const found = extent(item);
    if (!found) continue;
    left = Math.min(left, found.x);
    right = Math.max(right, found.x + found.width);
    top = Math.min(top, found.y);
    bottom = Math.max(bottom, found.y + found.height);
  }
  if (!(right > left) || !(bottom > top)) return { x: 0, y: 0, width: 100, height: 100 };
  const margin = kMargin * Math.max(right - left, bottom - top);
  return { x: left - margin, y: top - margin, width: right - left + 2 * margin, height: bottom - top + 2 * margin };
}

// The part of the plan that fits a window of this shape, at this zoom, kept inside the whole.
function framed(all: Frame, aspect: number, zoom: number, centre: [number, number]): Frame {
  let width = all.width,
    height = all.height;
  if (width / height > aspect) height = width / aspect;
  else width = height * aspect;
  width /= zoom;
  height /= zoom;
  const inside = (at: number, size: number, from: number, length: number): number =>
    size >= length ? from + length / 2 - size / 2 : Math.min(from + length - size, Math.max(from, at - size / 2));
  return { x: inside(centre[0], width, all.x, all.width), y: inside(centre[1], height, all.y, all.height), width, height };
}

// A finger that misses a small thing narrowly means it all the same.
function nearest(items: [string, PlanItem][], place: [number, number], reach: number): string | null {
  let best: string | null = null,
    least = reach;
  for (const [id, item] of items) {
    const found = item.kind === "volume" || item.kind === "building" ? extent(item) : null;
    if (!found) continue;
    const dx = Math.max(found.x - place[0], 0, place[0] - found.x - found.width),
      dy = Math.max(found.y - place[1], 0, place[1] - found.y - found.height);
    const far = Math.hypot(dx, dy);
    if (far < least) [best, least] = [id, far];
  }
  return best;
}

interface View {
  zoom: number;
  centre: [number, number];
}

function Shape({ id, item, isSelected }: { id: string; item: PlanItem; isSelected: boolean }): JSX.Element {
  const unmet = item.met === false ? "unmet" : "";
  return (
    <path
      class={`shape ${item.kind} ${unmet} ${isSelected ? "selected" : ""}`}
      data-node={id}
      d={item.d}
      fill={item.kind === "street" ? "none" : item.fill}
    />
  );
}


function Label({ name }: { name: Name }): JSX.Element {
  const { lines, x, y, font } = name;
  return (
    <text class={`name ${name.kind}`} font-size={font} stroke-width={font * (name.kind === "street" ? 0.7 : 0.22)}>
      {lines.map((line, i) => (
        <tspan key={line} x={x} y={y + font * (0.35 + (i - (lines.length - 1) / 2) * 1.1)}>
          {line}
        </tspan>
      ))}
    </text>
  );
}

function PinShape({ pin, unit, size }: { pin: Pin; unit: number; size: number }): JSX.Element {
  const r = size * unit;
  return (
    <g class={`pin ${pin.tone}`} transform={`translate(${pin.x} ${-pin.y})`}>
      <circle r={r} stroke-width={r * 0.18} />
      <text font-size={r * 1.15} y={r * 0.4}>
        {pin.letter}
      </text>
    </g>
  );
}

function OutlineShape({ outline: { corners, name, isOpen }, font }: { outline: Outline; font: number }): JSX.Element {
  const all = corners.map(([x, y]) => `${x} ${-y}`),
    top = Math.max(...corners.map(([, y]) => y)),
    // Its name stands where it is highest, because the names of things stand inside.
    highest = corners.filter(([, y]) => y > top - font).map((corner) => corner[0]);
  return (
    <g class={`outline ${name === "" ? "own" : ""}`}>
      <path d={`M${all.join("L")}${isOpen ? "" : "Z"}`} />
      {name === "" ? null : (
        <text class="name" x={(Math.min(...highest) + Math.max(...highest)) / 2} y={0.35 * font - top} font-size={font} stroke-width={font * 0.3}>
          {name}
        </text>
      )}
    </g>
  );
}

export interface PlanProps {
  s: Session;
  binding: Binding | null;
  selected: string | null;
  label?: number;
  isStill?: boolean;
  children?: ComponentChildren; ///< drawn over the outlines, in metres with y downwards
}

export function Plan({ s, binding, selected, label = 12, isStill, children }: PlanProps): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState<[number, number]>([360, 300]);
  const [view, setView] = useState<View>({ zoom: 1, centre: [0, 0] });
  const items = s.plan().sort((a, b) => kOrder.indexOf(a[1].kind) - kOrder.indexOf(b[1].kind));
  const all = whole(items),
    frame = framed(all, size[0] / size[1], view.zoom, view.centre),
    unit = frame.width / size[0];

  useLayoutEffect(() => {
    const measure = (): void => {
      const rect = box.current?.getBoundingClientRect();
      if (rect && rect.width > 0 && rect.height > 0) setSize([rect.width, rect.height]);
    };
    // It tells the first size after the browser has laid the page out, and before it is painted. Asking here would lay it out at once.
    if (typeof ResizeObserver === "undefined") {
      measure();
      window.addEventListener("resize", measure);
      return () => window.removeEventListener("resize", measure);
    }
    const watcher = new ResizeObserver(measure);
    if (box.current) watcher.observe(box.current);
    return () => watcher.disconnect();
  }, []);

  const live = useRef({ frame, view, all, size });
  live.current = { frame, view, all, size };
  const at = (clientX: number, clientY: number): [number, number] => {
    const rect = box.current?.getBoundingClientRect(),
      { frame: now } = live.current;
    if (!rect || rect.width === 0) return [now.x, now.y];
    return [now.x + ((clientX - rect.left) / rect.width) * now.width, now.y + ((clientY - rect.top) / rect.height) * now.height];
  };
  // Zooms so that the point under the finger stays there.
  const zoomAt = (factor: number, fixed: [number, number]): void =>
    setView((old) => {
      const { all: now, size: shape } = live.current;
      const before = framed(now, shape[0] / shape[1], old.zoom, old.centre);
      const zoom = Math.min(kMost, Math.max(1, old.zoom * factor)),
        ratio = old.zoom / zoom;
      const middleOf: [number, number] = [before.x + before.width / 2, before.y + before.height / 2];
      return { zoom, centre: [fixed[0] + (middleOf[0] - fixed[0]) * ratio, fixed[1] + (middleOf[1] - fixed[1]) * ratio] };
    });
  const centre = (): [number, number] => [frame.x + frame.width / 2, frame.y + frame.height / 2];
  const moveBy = (dx: number, dy: number): void =>
    setView((old) => {
      const { all: now, size: shape } = live.current;
      const before = framed(now, shape[0] / shape[1], old.zoom, old.centre);
      return { ...old, centre: [before.x + before.width / 2 + dx, before.y + before.height / 2 + dy] };
    });

  useFingers(
    box,
    {
      at,
      zoomAt,
      moveBy,
      isStill: isStill ?? false,
      zoom: () => live.current.view.zoom,
      unit: () => live.current.frame.width / live.current.size[0],
    },
    (place, node) => {
      const scale = live.current.frame.width / live.current.size[0];
      binding?.onTap([round(place[0]), round(-place[1]), 0], node ?? nearest(items, place, kNear * scale), kReach * scale);
    },
  );

  // What is chosen elsewhere comes into sight.
  useEffect(() => {
    const item = selected === null ? undefined : items.find(([id]) => id === selected)?.[1];
    const found = item && extent(item);
    if (found && live.current.view.zoom > 1) setView((old) => ({ ...old, centre: middle_of(found) }));
  }, [selected]);

  const keys = (event: KeyboardEvent): void => {
    if (is_of_browser(event)) return;
    const far = frame.width / 6;
    const moves: Record<string, [number, number]> = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] };
    const move = moves[event.key];
    if (move) moveBy(...move);
    else if (event.key === "+" || event.key === "=") zoomAt(1.5, centre());
    else if (event.key === "-") zoomAt(1 / 1.5, centre());
    else if (event.key === "0") setView({ zoom: 1, centre: [0, 0] });
    else return;
    event.preventDefault();
  };

  const count = items.filter(([, item]) => item.kind === "volume" || item.kind === "building").length;
  const viewBox = `${frame.x} ${frame.y} ${frame.width} ${frame.height}`;
  return (
    <div
      style={{ "--aspect": `${all.width / all.height}` }}
      class={`plan ${view.zoom > 1 ? "zoomed" : ""} ${isStill ? "still" : ""}`}
      onKeyDown={isStill ? undefined : keys}
    >
      <div class="paper" ref={box}>
        {items.length === 0 ? <p class="empty">{t("no_plan")}</p> : null}
        <svg viewBox={viewBox} role="img" aria-label={t("plan_of", { n: count })}>
          {items.map(([id, item]) => (
            <Shape key={id} id={id} item={item} isSelected={id === selected} />
          ))}
          {children}
          {names_of(items, isStill ? [label * unit] : [label * unit, label * unit * 0.82], frame).map((name) => (
            <Label key={name.id} name={name} />
          ))}
          {(binding?.outlines ?? []).map((outline) => (
            <OutlineShape key={outline.id} outline={outline} font={label * unit} />
          ))}
          {(binding?.pins ?? []).map((pin) => (
            <PinShape key={pin.id} pin={pin} unit={unit} size={label} />
          ))}
        </svg>
      </div>
      {isStill ? null : (
        <div class="zoom" role="group" aria-label={t("plan")}>
          <button class="round" aria-label={t("zoom_in")} disabled={view.zoom >= kMost} onClick={() => zoomAt(1.6, centre())}>
            <Icon name="plus" />
          </button>
          <button class="round" aria-label={t("zoom_out")} disabled={view.zoom <= 1} onClick={() => zoomAt(1 / 1.6, centre())}>
            <Icon name="minus" />
          </button>
          {view.zoom > 1 ? (
            <>
              <button class="round" aria-label={t("zoom_all")} onClick={() => setView({ zoom: 1, centre: [0, 0] })}>
                <Icon name="all" />
              </button>
            </>
          ) : null}
        </div>
      )}
      {view.zoom > 1 && !isStill ? (
        <div class="pad" role="group" aria-label={t("plan")}>
          <button class="round" aria-label={t("move_left")} onClick={() => moveBy(-frame.width / 4, 0)}>
            <Icon name="left" />
          </button>
          <button class="round" aria-label={t("move_up")} onClick={() => moveBy(0, -frame.height / 4)}>
            <Icon name="up" />
          </button>
          <button class="round" aria-label={t("move_down")} onClick={() => moveBy(0, frame.height / 4)}>
            <Icon name="down" />
          </button>
          <button class="round" aria-label={t("move_right")} onClick={() => moveBy(frame.width / 4, 0)}>
            <Icon name="right" />
          </button>
        </div>
      ) : null}
    </div>
  );
}

const round = (value: number): number => Math.round(value * 10) / 10;

interface Moves {
  at(x: number, y: number): [number, number];
  zoomAt(factor: number, fixed: [number, number]): void;
  moveBy(dx: number, dy: number): void;
  zoom(): number;
  unit(): number;
  isStill: boolean;
}

// Fingers, pen and mouse: one moves the plan where it is enlarged, two enlarge it, a short touch asks.
function useFingers(
  box: { current: HTMLDivElement | null },
  moves: Moves,
  tap: (place: [number, number], node: string | null) => void,
): void {
  const latest = useRef({ moves, tap });
  latest.current = { moves, tap };
  useEffect(() => {
    const element = box.current;
    if (!element || moves.isStill) return;
    const fingers = new Map<number, [number, number]>();
    let start: { x: number; y: number; at: number; isMoved: boolean } | null = null;
    const down = (event: PointerEvent): void => {
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      start = fingers.size === 1 ? { x: event.clientX, y: event.clientY, at: event.timeStamp, isMoved: false } : null;
    };
    const move = (event: PointerEvent): void => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const { moves: now } = latest.current,
        others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      const other = others[0];
      if (other) {
        const length = (point: [number, number]): number => Math.hypot(point[0] - other[0], point[1] - other[1]);
        const from = length(before);
        if (from > 0)
          now.zoomAt(length([event.clientX, event.clientY]) / from, now.at((event.clientX + other[0]) / 2, (event.clientY + other[1]) / 2));
        return;
      }
      if (start && Math.hypot(event.clientX - start.x, event.clientY - start.y) > kTap) {
        if (!start.isMoved && now.zoom() > 1) element.setPointerCapture(event.pointerId);
        start.isMoved = true;
      }
      if (start?.isMoved && now.zoom() > 1) now.moveBy((before[0] - event.clientX) * now.unit(), (before[1] - event.clientY) * now.unit());
    };
    const up = (event: PointerEvent): void => {
      fingers.delete(event.pointerId);
      const began = start;
      start = null;
      if (!began || began.isMoved || event.type !== "pointerup" || event.timeStamp - began.at > kLongTap) return;
      const shape = (event.target as Element).closest?.("[data-node]");
      latest.current.tap(latest.current.moves.at(event.clientX, event.clientY), shape?.getAttribute("data-node") ?? null);
    };
    const wheel = (event: WheelEvent): void => {
      const { moves: now } = latest.current;
      if (!event.ctrlKey && now.zoom() <= 1 && event.deltaY > 0) return;
      event.preventDefault();
      now.zoomAt(Math.exp(-event.deltaY * 0.0015), now.at(event.clientX, event.clientY));
    };
    element.addEventListener("pointerdown", down);
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", up);
    element.addEventListener("pointercancel", up);
    element.addEventListener("wheel", wheel, { passive: false });
    return () => {
      element.removeEventListener("pointerdown", down);
      element.removeEventListener("pointermove", move);
      element.removeEventListener("pointerup", up);
      element.removeEventListener("pointercancel", up);
      element.removeEventListener("wheel", wheel);
    };
  }, [moves.isStill]);
}
