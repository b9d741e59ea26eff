// The small parts that all screens share: the line about the connection, states of changes, controls, and dialogs.
import type { ComponentChildren, JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { countdown, duration } from "./format";
import type { Session } from "./session";
import { useClock } from "./ui";
import { Key, t } from "./words";

// --- Icons ----------------------------------------------------------------------------------------------------------

const kIcons = {
  now: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18m0 4v5l3.5 2",
  plan: "M3 6l6-2 6 2 6-2v14l-6 2-6-2-6 2zM9 4v14M15 6v14",
  card: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18m0 4.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9m0 4v1",
  votes: "M4 5h16v14H4zM8 12l3 3 5-6",
  ideas: "M4 5h16v11h-8l-4 4v-4H4z",
  lead: "M5 4v7m0 4v5M12 4v3m0 4v9M19 4v9m0 4v3M3 13h4M10 9h4M17 15h4",
  check: "M5 12.5l4.5 4.5L19 7.5",
  cross: "M6 6l12 12M18 6L6 18",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  all: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  up: "M12 19V5M6 11l6-6 6 6",
  down: "M12 5v14M6 13l6 6 6-6",
  left: "M19 12H5M11 6l-6 6 6 6",
  right: "M5 12h14M13 6l6 6-6 6",
  move: "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3",
  pin: "M12 21c-4-5-6-8-6-11a6 6 0 0 1 12 0c0 3-2 6-6 11m0-13v4",
  undo: "M8 5L4 9l4 4M4 9h10a5 5 0 0 1 0 10h-4",
  redo: "M16 5l4 4-4 4M20 9H10a5 5 0 0 0 0 10h4",
  thumb: "M7 11l4-7a2 2 0 0 1 2 2v4h6l-1.5 9H7zM7 11H4v8h3",
  pause: "M8 5v14M16 5v14",
  play: "M7 5l12 7-12 7z",
  clock: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16m0 3.5V12l3 2",
};
export type IconName = keyof typeof kIcons;

export function Icon({ name, class: kind = "" }: { name: IconName; class?: string }): JSX.Element {
  return (
    <svg class={`icon ${kind}`} viewBox="0 0 24 24" aria-hidden="true" focusable="false">
      <path d={kIcons[name]} />
    </svg>
  );
}

// --- The connection -------------------------------------------------------------------------------------------------

/// One line: is everything saved, does something wait, is there a connection?
export function StatusLine({ s }: { s: Session }): JSX.Element {
  useClock(1000);
  const { connection } = s;
  const n = connection.waiting,
    away = s.now() - connection.since;
  const isGone = !connection.isOpen && away > 1000;
  const parts: string[] = [];
  if (connection.isOpen) parts.push(n > 0 ? t("sending", { n }) : t("saved"));
  else {
    if (n > 0) parts.push(t("waits", { n }));
    parts.push(isGone && s.you ? t("no_connection", { time: duration(away) }) : t("connecting"));
  }
  const tone = connection.isOpen ? (n > 0 ? "busy" : "good") : isGone ? "bad" : "busy";
  return (
    <p class={`status ${tone}`}>
      <i class="light" aria-hidden="true" />
      <span>{parts.join(" · ")}</span>
    </p>
  );
}

/// Where the room may be found instead, while this page has no connection.
export function Moved({ s }: { s: Session }): JSX.Element | null {
  useClock(1000);
  const places = s.places(),
    [first] = places,
    n = s.connection.waiting;
  if (!first) return null;
  return (
    <div class="notice moved" role="status">
      {places.map(({ address, link }) => (
        <p key={address}>
          {t("moved")} <a href={link}>{address}</a>
        </p>
      ))}
      {n > 0 ? <p>{t(first.takesAlong ? "moved_along" : "moved_stays", { n })}</p> : null}
    </div>
  );
}

/// What to do about a connection that is gone for longer, and notices of the room.
export function Notices({ s }: { s: Session }): JSX.Element | null {
  useClock(1000);
  const out: string[] = [];
  if (!s.connection.isOpen && s.you && s.now() - s.connection.since > 8000) out.push(t("no_connection_hint"));
  if (!s.connection.queue.isKept) out.push(t("not_kept"));
  if (s.notices.some((notice) => notice.id === "host_away")) out.push(t("notice_host_away"));
  if (s.notices.some((notice) => notice.id === "storage")) out.push(t("notice_storage"));
  if (out.length === 0) return null;
  return (
    <div class="notice" role="status">
      {out.map((text) => (
        <p key={text}>{text}</p>
      ))}
    </div>
  );
}

/// What screen readers hear when the state of the connection or of a change turns, once.
export function Announcer({ s }: { s: Session }): JSX.Element {
  const isOpen = s.connection.isOpen;
  const saved = [...s.marks.values()].filter((mark) => mark.state === "saved").length;
  const [text, say] = useState("");
  const before = useRef({ isOpen, saved, votes: "" });
  const votes = Object.entries(s.views.votes)
    .filter(([, vote]) => vote.open)
    .map(([, vote]) => vote.question)
    .join("; ");
  useEffect(() => {
    const was = before.current;
    before.current = { isOpen, saved, votes };
    if (was.isOpen && !isOpen) say(t("connecting"));
    else if (votes !== "" && was.votes !== votes) say(`${t("now_vote")}: ${votes}`);
    else if (saved > was.saved) say(t("state_saved"));
  }, [isOpen, saved, votes]);
  return (
    <div class="unseen" role="status" aria-live="polite">
      {text}
    </div>
  );
}

// --- States of changes ----------------------------------------------------------------------------------------------

/// Sending, saved or not, beside the control that it came from. It keeps its place, so that nothing jumps.
export function MarkState({ s, mark }: { s: Session; mark: string }): JSX.Element {
  const one = s.mark(mark);
  if (!one) return <span class="mark" />;
  if (one.state === "sending")
    return (
      <span class="mark busy">
        <i class="ring" aria-hidden="true" />
        {t(s.connection.isOpen ? "state_sending" : "state_waiting")}
      </span>
    );
  if (one.state === "saved")
    return (
      <span class="mark good">
        <Icon name="check" />
        {t("state_saved")}
      </span>
    );
  if (one.state === "elsewhere") return <span class="mark">{t("state_elsewhere")}</span>;
  return (
    <span class="mark bad">
      <Icon name="cross" />
      {t("state_refused")}
    </span>
  );
}

// --- Controls -------------------------------------------------------------------------------------------------------

export function Timer({ s, ends_at }: { s: Session; ends_at: number | undefined }): JSX.Element | null {
  useClock(1000);
  if (!ends_at) return null;
  const left = ends_at - s.now();
  return (
    <p class={`timer ${left < 30000 ? "late" : ""}`} role="timer">
      <Icon name="clock" />
      {left > 0 ? t("time_left", { time: countdown(left) }) : t("time_over")}
    </p>
  );
}

/// A dialog that takes the focus, gives it back, and closes by Escape.
export function Sheet(props: { title: string; onClose(): void; children: ComponentChildren }): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    box.current?.focus();
    return () => {
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  const keep = (event: KeyboardEvent): void => {
    if (event.key === "Escape") props.onClose();
    if (event.key !== "Tab" || !box.current) return;
    const all = [...box.current.querySelectorAll<HTMLElement>("button, input, select, textarea, summary, a[href]")];
    const first = all[0],
      last = all[all.length - 1];
    const at = document.activeElement;
    if (event.shiftKey ? at === first || at === box.current : at === last) {
      event.preventDefault();
      (event.shiftKey ? last : first)?.focus();
    }
  };
  return (
    <div class="veil" onClick={(event) => event.target === event.currentTarget && props.onClose()}>
      <div class="sheet" role="dialog" aria-modal="true" aria-label={props.title} tabIndex={-1} ref={box} onKeyDown={keep}>
        <header class="row spread">
          <h2>{props.title}</h2>
          <button class="round" aria-label={t("close")} onClick={props.onClose}>
            <Icon name="cross" />
          </button>
        </header>
        {props.children}
      </div>
    </div>
  );
}

/// Asks before something that cannot be taken back easily.
export function Sure(props: { text: string; yes: string; onYes(): void; children: string; class?: string }): JSX.Element {
  const [isAsking, ask] = useState(false);
  if (!isAsking)
    return (
      <button class={props.class ?? "quiet"} onClick={() => ask(true)}>
        {props.children}
      </button>
    );
  return (
    <div class="sure" role="group" aria-label={props.text}>
      <p>{props.text}</p>
      <div class="row">
        <button
          class="danger"
          onClick={() => {
            ask(false);
            props.onYes();
          }}
        >
          {props.yes}
        </button>
        <button class="quiet" onClick={() => ask(false)}>
          {t("lead_cancel")}
        </button>
      </div>
    </div>
  );
}

export function StatusWord({ status }: { status: string }): JSX.Element {
  const known = status === "met" || status === "close" ? status : "far";
  return (
    <span class={`word ${known}`}>
      <i aria-hidden="true" />
      {t(`status_${known}` as Key)}
    </span>
  );
}

export function Avatar({ name, colour }: { name: string; colour: string }): JSX.Element {
  return (
    <span class="avatar" aria-hidden="true" style={{ background: colour }}>
      <span>{name.slice(0, 1)}</span>
    </span>
  );
}

/// Some of several choices, as buttons side by side.
export function Segments<T extends string>(props: {
  label: string;
  value: T;
  choices: { id: T; text: string }[];
  onChange(id: T): void;
}): JSX.Element {
  return (
    <div class="segments" role="group" aria-label={props.label}>
      {props.choices.map((choice) => (
        <button key={choice.id} aria-pressed={choice.id === props.value} onClick={() => props.onChange(choice.id)}>
          {choice.text}
        </button>
      ))}
    </div>
  );
}

/// The title of a screen; it takes the focus when the screen changes, so that screen readers begin there.
export function Title({ children }: { children: ComponentChildren }): JSX.Element {
  return <h1 tabIndex={-1}>{children}</h1>;
}
