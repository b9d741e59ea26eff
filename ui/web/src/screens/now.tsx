// The one thing to do now, which the phase of the session gives.
import type { JSX } from "preact";
import { Icon, Title, Timer } from "../parts";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Tab, Ui } from "../ui";
import { t } from "../words";
import { Happened } from "./happened";
import { WhatIsThis } from "./plan_screen";

interface Task {
  kind: string;
  title: string;
  text: string;
  action?: string;
  go?: Tab;
  isDone?: boolean;
  more?: () => void;
}

export function task_of(s: Session, ui: Ui): Task {
  const { phase } = s.views.room,
    activities = phase?.activities ?? [];
  const open = Object.entries(s.views.votes).filter(([, vote]) => vote.open);
  const due = open.find(([id, vote]) => !s.hasVoted(id, vote) && s.mark(`vote/${id}`)?.state !== "sending");
  const hasCard = (s.views.card.controls ?? []).length > 0;
  const isOver = s.views.room.closed === true,
    isMuted = s.views.room.seats?.[s.you?.seat ?? 0]?.muted === true;
  const hasResult = Object.values(s.views.votes).some((vote) => vote.result !== null && vote.count > 0 && !vote.open);
  if (isOver && hasResult) return { kind: "votes", title: t("now_result"), text: "", action: t("see_result"), go: "votes" };
  if (isOver) return { kind: "look", title: t("now_look"), text: t("now_look_text"), action: t("open_plan"), go: "plan" };
  if (s.views.room.seats?.[s.you?.seat ?? 0]?.waits)
    return { kind: "look", title: t("door_title"), text: t("now_door"), action: t("open_plan"), go: "plan" };
  if (isMuted) return { kind: "look", title: t("now_look"), text: t("now_muted"), action: t("open_plan"), go: "plan" };
  const canSpeak = s.you?.role !== "viewer";
  if (due && canSpeak) return { kind: "vote", title: t("now_vote"), text: due[1].question, action: t("vote_now"), go: "votes" };
  if (activities.includes("change") && hasCard)
    return { kind: "card", title: t("now_change"), text: t("now_change_text"), action: t("open_card"), go: "card" };
  if ((phase?.forms ?? []).includes("smart_volume") && canSpeak)
    return { kind: "ideas", title: t("now_form"), text: t("now_form_text"), action: t("start"), go: "form" };
  if (activities.includes("comment") && canSpeak)
    return {
      kind: "ideas",
      title: t("now_comment"),
      text: t("now_comment_text"),
      action: t("write"),
      go: "ideas",
      more: () => ui.set({ part: "comments", isWriting: true, parent: null, selected: null, place: null }),
    };
  if (activities.includes("draft") && canSpeak && hasCard)
    return {
      kind: "ideas",
      title: t("now_draft"),
      text: t("now_draft_text"),
      action: t("start"),
      go: "ideas",
      more: () => ui.set({ part: "proposals" }),
    };
  const counted = open.find(([id, vote]) => s.hasVoted(id, vote));
  if (counted)
    return { kind: "votes", title: t("now_vote_done"), text: t("now_vote_change"), action: t("change_vote"), go: "votes", isDone: true };
  if (hasResult) return { kind: "votes", title: t("now_result"), text: "", action: t("see_result"), go: "votes" };
  if (!phase || activities.length > 0)
    return { kind: "plan", title: t("now_look"), text: t("now_look_text"), action: t("open_plan"), go: "plan" };
  return { kind: "now", title: t("now_wait"), text: t("now_wait_text") };
}

export function Now({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const { phase, paused, closed } = s.views.room,
    task = task_of(s, ui);
  return (
    <>
      {closed ? null : (
        <div class="phase">
          <p class="faint">{phase?.name ?? ""}</p>
          <Timer s={s} ends_at={phase?.ends_at} />
        </div>
      )}
      <section class={`task ${task.isDone ? "done" : ""}`}>
        <Title>
          {task.isDone ? <Icon name="check" /> : null}
          {task.title}
        </Title>
        {task.text ? <p class="lead">{task.text}</p> : null}
        {task.action && task.go ? (
          <button
            class={task.isDone ? "quiet" : "main"}
            onClick={() => {
              task.more?.();
              ui.go(task.go as Tab);
            }}
          >
            {task.action}
            <Icon name="right" />
          </button>
        ) : null}
        {paused && !closed ? (
          <p class="small">
            <Icon name="pause" />
            {t("now_paused")}
          </p>
        ) : null}
      </section>
      <PlanHere s={s} ui={ui} binding={{ pins: [], onTap: (_, node) => ui.set({ selected: node }) }} />
      <WhatIsThis s={s} ui={ui} />
      <Happened s={s} />
    </>
  );
}
