// Fingers, pen, mouse and wheel on the picture: one turns it or moves it, two enlarge and move it, a short touch asks.

export interface Gestures {
  turn(right: number, down: number): void; ///< parts of the picture's height
  move(right: number, down: number): void;
  zoom(factor: number): void; ///< above 1: nearer
  tap(x: number, y: number): void; ///< CSS pixels inside the picture
  isMoving(): boolean; ///< does one finger move instead of turning?
}

const kTap = 10, // [CSS px]
  kLongTap = 600; // [ms]

/// Listens until the returned function is called.
export function follow_fingers(element: HTMLElement, gestures: Gestures): () => void {
  const fingers = new Map<number, [number, number]>();
  let start: { x: number; y: number; at: number; isMoved: boolean } | null = null;
  const part = (pixels: number): number => pixels / Math.max(1, element.clientHeight);
  const down = (event: PointerEvent): void => {
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    element.setPointerCapture(event.pointerId);
    start = fingers.size === 1 ? { x: event.clientX, y: event.clientY, at: event.timeStamp, isMoved: false } : null;
  };
  const move = (event: PointerEvent): void => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now: [number, number] = [event.clientX, event.clientY],
      right = part(now[0] - before[0]),
      below = part(now[1] - before[1]);
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (start && Math.hypot(now[0] - start.x, now[1] - start.y) > kTap) start.isMoved = true;
    if (start && !start.isMoved) return;
    fingers.set(event.pointerId, now);
    if (other) {
      const from = Math.hypot(before[0] - other[0], before[1] - other[1]),
        to = Math.hypot(now[0] - other[0], now[1] - other[1]);
      if (from > 0 && to > 0) gestures.zoom(to / from);
      // The middle of both moves by half of what one of them does.
      gestures.move(right / 2, below / 2);
    } else if (gestures.isMoving() || event.shiftKey || (event.buttons & 2) !== 0) gestures.move(right, below);
    else gestures.turn(right, below);
  };
  const up = (event: PointerEvent): void => {
    fingers.delete(event.pointerId);
    const began = start;
    start = null;
    if (!began || began.isMoved || event.type !== "pointerup" || event.timeStamp - began.at > kLongTap) return;
    const box = element.getBoundingClientRect();
    gestures.tap(event.clientX - box.left, event.clientY - box.top);
  };
  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    gestures.zoom(Math.exp(-event.deltaY * 0.0012));
  };
  const menu = (event: Event): void => event.preventDefault();
  element.addEventListener("pointerdown", down);
  element.addEventListener("pointermove", move);
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
  element.addEventListener("wheel", wheel, { passive: false });
  element.addEventListener("contextmenu", menu);
  return () => {
    element.removeEventListener("pointerdown", down);
    element.removeEventListener("pointermove", move);
    element.removeEventListener("pointerup", up);
    element.removeEventListener("pointercancel", up);
    element.removeEventListener("wheel", wheel);
    element.removeEventListener("contextmenu", menu);
  };
}
