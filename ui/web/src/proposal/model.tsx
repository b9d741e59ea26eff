// The model in three dimensions, with buttons and keys as on the page of a room.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { Picture, Step } from "../space/picture";
import { Buttons, North, kKeys, looks_of } from "../space_controls";
import { is_of_browser, useMedia } from "../ui";
import type { Proposal } from "./data";

export interface Choice {
  chosen: string | null; ///< id of a building
  choose(id: string | null): void;
}

/// `shapes`: what the picture shows, the whole model or a part of it.
export function Model({ proposal, shapes, chosen, choose }: { proposal: Proposal; shapes: Record<string, unknown> } & Choice): JSX.Element {
  const box = useRef<HTMLDivElement>(null),
    canvas = useRef<HTMLCanvasElement>(null),
    overlay = useRef<HTMLDivElement>(null),
    north = useRef<SVGGElement | null>(null),
    picture = useRef<Picture | null>(null);
  const [isFailed, setFailed] = useState(false),
    [isMoving, setMoving] = useState(false);
  const isDark = useMedia("(prefers-color-scheme: dark)"),
    isCalm = useMedia("(prefers-reduced-motion: reduce)");
  useEffect(() => {
    if (!canvas.current || !overlay.current || !box.current) return;
    try {
      picture.current = new Picture({
        canvas: canvas.current,
        overlay: overlay.current,
        looks: looks_of(box.current, isDark),
        isCalm,
        onTap: (_place, node) => choose(node?.startsWith("building/") ? node.slice("building/".length) : null),
        onLook: (azimuth) => north.current?.setAttribute("transform", `rotate(${(proposal.true_north - azimuth * (180 / Math.PI)).toFixed(1)})`),
      });
    } catch {
      setFailed(true);
    }
    return () => {
      picture.current?.dispose();
      picture.current = null;
    };
  }, [isDark, isCalm]);
  useEffect(() => {
    if (picture.current) picture.current.isMoving = isMoving;
    picture.current?.show(shapes, new Map(Object.entries(proposal.looks)), [], chosen === null ? null : `building/${chosen}`);
  });
  const step = (what: Step): void => picture.current?.step(what);
  const keys = (event: KeyboardEvent): void => {
    const what = is_of_browser(event) ? undefined : kKeys[event.key];
    if (!what) return;
    step(what);
    event.preventDefault();
  };
  const count = proposal.buildings.length;
  if (isFailed) return <p class="plan message">This browser shows no picture in three dimensions. The plans and tables say the same.</p>;
  return (
    <div class="plan space" ref={box} onKeyDown={keys}>
      <canvas
        key={`${isDark} ${isCalm}`}
        ref={canvas}
        tabIndex={0}
        role="img"
        aria-label={`Picture in three dimensions of ${count} ${count === 1 ? "building" : "buildings"}. Arrow keys turn it, + and - enlarge it, 0 shows all. The tables say the same.`}
      />
      <div class="names" ref={overlay} aria-hidden="true" />
      <North turned={north} />
      <Buttons step={step} isMoving={isMoving} setMoving={setMoving} />
    </div>
  );
}
