// What people say and propose: comments on places and things, and proposals that can be compared.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { Icon, MarkState, Segments, Title } from "../parts";
import { middle } from "../plan_names";
import { PlanHere } from "../space";
import type { Session } from "../session";
import type { Pin, Ui } from "../ui";
import type { Comment, Json, Point } from "../wire";
import { t } from "../words";
import { Proposals } from "./proposals";
import { place_name } from "./ballot_forms";

const kMostText = 2000;

/// Where a comment stands on the plan: its own place, or that of its thing.
export function comment_place(s: Session, comment: Comment): Point | null {
  const place = comment.place as Point | Point[] | undefined;
  if (place && place.length > 0) return (Array.isArray(place[0]) ? place[0] : place) as Point;
  const item = comment.node ? s.plan().find(([id]) => id === comment.node)?.[1] : undefined;
  return item ? middle(item) : null;
}

export function comment_pins(s: Session): Pin[] {
  const pins: Pin[] = [];
  Object.entries(s.views.comments).forEach(([id, comment], i) => {
    const place = comment.parent ? null : comment_place(s, comment);
    if (place) pins.push({ id, x: place[0], y: place[1], letter: String(i + 1), tone: "say", label: comment.text });
  });
  return pins;
}

// Streets, plots and buildings stand on the plan without a node of their own; a comment on them is one on their place.
function anchor_of(s: Session, id: string): Record<string, Json> {
  if (!id.includes("/")) return { node: id };
  const item = s.plan().find(([one]) => one === id)?.[1];
  const place = item && middle(item);
  return place ? { place: [place] } : {};
}

function about(s: Session, node: string | null | undefined, place: Point | null): string {
  if (node) return s.nameOf(node);
  return place ? `${t("comment_place")} (${place_name(s, place)})` : t("comment_all");
}

// The words come first: on a phone, a plan above them would push them out of sight.
function Write({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const [text, set] = useState("");
  const left = kMostText - [...text].length,
    parent = ui.parent ? s.views.comments[ui.parent] : undefined;
  const send = (): void => {
    const args: Record<string, Json> = { id: s.freshName("comment"), text: text.trim() };
    if (ui.parent) args.parent = ui.parent;
    else if (ui.place) args.place = [ui.place];
    else if (ui.selected) Object.assign(args, anchor_of(s, ui.selected));
    s.event("comment", args, { mark: "comment/new", shown: text.trim() });
    set("");
    ui.set({ isWriting: false, place: null, parent: null });
  };
  const pins: Pin[] = ui.place ? [{ id: "new", x: ui.place[0], y: ui.place[1], letter: "!", tone: "mine", label: t("comment_new") }] : [];
  return (
    <section class="write">
      {parent ? <blockquote>{parent.text}</blockquote> : null}
      <label class="field">
        <span>{t("comment_text")}</span>
        <textarea rows={4} value={text} maxLength={kMostText * 2} onInput={(event) => set(event.currentTarget.value)} />
      </label>
      {left < 200 ? <p class={left < 0 ? "wrong" : "small"}>{t("comment_left", { n: left })}</p> : null}
      <div class="row">
        <button class="main" disabled={text.trim() === "" || left < 0} onClick={send}>
          {t("comment_send")}
        </button>
        <button class="quiet" onClick={() => ui.set({ isWriting: false, parent: null })}>
          {t("lead_cancel")}
        </button>
      </div>
      {parent ? null : (
        <>
          <div class="row spread">
            <p>
              {t("comment_about")}: <b>{about(s, ui.selected, ui.place)}</b>
            </p>
            {ui.selected || ui.place ? (
              <button class="link" onClick={() => ui.set({ selected: null, place: null })}>
                {t("clear_place")}
              </button>
            ) : null}
          </div>
          <p class="how">{t("comment_pick")}</p>
          <PlanHere
            s={s}
            ui={ui}
            binding={{
              pins,
              onTap: (place, node) => ui.set(node && s.nameOf(node) !== node ? { selected: node, place: null } : { selected: null, place }),
            }}
          />
        </>
      )}
    </section>
  );
}

function Rate({ s, id, comment }: { s: Session; id: string; comment: Comment }): JSX.Element {
  const mark = `rating/${id}`,
    shown = s.shown(mark, "comments");
  const mine = typeof shown === "number" ? shown : comment.mine;
  const plus = comment.plus + (mine === 1 ? 1 : 0) - (comment.mine === 1 ? 1 : 0),
    minus = comment.minus + (mine === -1 ? 1 : 0) - (comment.mine === -1 ? 1 : 0);
  const rate = (rating: number): void =>
    s.event("rate_comment", { comment: id, rating: mine === rating ? 0 : rating }, { mark, shown: mine === rating ? 0 : rating });
  const isOwn = comment.seat === s.you?.seat;
  return (
    <>
      <button class="rate" aria-pressed={mine === 1} disabled={isOwn} aria-label={t("agree_n", { n: plus })} onClick={() => rate(1)}>
        <Icon name="thumb" />
        {plus}
      </button>
      <button class="rate" aria-pressed={mine === -1} disabled={isOwn} aria-label={t("disagree_n", { n: minus })} onClick={() => rate(-1)}>
        <Icon name="thumb" class="down" />
        {minus}
      </button>
    </>
  );
}

function CommentEntry({
  s,
  ui,
  id,
  n,
  comment,
  replies,
}: {
  s: Session;
  ui: Ui;
  id: string;
  n: number;
  comment: Comment;
  replies: [string, Comment][];
}): JSX.Element {
  const isOwn = comment.seat === s.you?.seat,
    place = comment_place(s, comment);
  return (
    <li class="comment">
      <p class="faint">
        <b class="spot say">{n}</b>
        {isOwn ? t("comment_yours") : s.seatName(comment.seat)}
        {comment.node || place ? ` · ${about(s, comment.node, place)}` : ""}
      </p>
      <p class="said">{comment.text}</p>
      {comment.state !== "open" || comment.answer ? (
        <div class={`answer ${comment.state}`}>
          <b>
            {comment.state === "open" ? t("comment_answer") : t(comment.state === "accepted" ? "comment_accepted" : "comment_rejected")}
          </b>
          {comment.answer ? <p>{comment.answer}</p> : null}
        </div>
      ) : null}
      {replies.map(([key, reply]) => (
        <p key={key} class="reply">
          <b>{reply.seat === s.you?.seat ? t("comment_yours") : s.seatName(reply.seat)}:</b> {reply.text}
        </p>
      ))}
      <div class="row">
        <Rate s={s} id={id} comment={comment} />
        {s.may("comment") ? (
          <button class="link" onClick={() => ui.set({ parent: id, isWriting: true })}>
            {t("comment_reply")}
          </button>
        ) : null}
      </div>
    </li>
  );
}

function Comments({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const [filter, set] = useState<"all" | "mine" | "open">("all");
  const all = Object.entries(s.views.comments),
    top = all.map(([id, comment], i) => ({ id, comment, n: i + 1 })).filter(({ comment }) => !comment.parent);
  const shown = top.filter(
    ({ comment }) => filter === "all" || (filter === "mine" ? comment.seat === s.you?.seat : comment.state === "open" && !comment.answer),
  );
  const may = s.may("comment");
  if (ui.isWriting && may) return <Write s={s} ui={ui} />;
  return (
    <>
      {may ? (
        <button class="main" onClick={() => ui.set({ isWriting: true, parent: null, selected: null, place: null })}>
          <Icon name="ideas" />
          {t("comment_new")}
        </button>
      ) : (
        <p class="notice">{t("comment_not_now")}</p>
      )}
      <MarkState s={s} mark="comment/new" />
      <PlanBeside s={s} ui={ui} />
      {top.length > 0 ? (
        <Segments
          label={t("ideas_comments")}
          value={filter}
          onChange={(one) => set(one)}
          choices={[
            { id: "all", text: t("filter_all") },
            { id: "mine", text: t("filter_mine") },
            { id: "open", text: t("filter_open") },
          ]}
        />
      ) : (
        <p class="empty">{t("no_comments")}</p>
      )}
      <ul class="comments">
        {shown.map(({ id, comment, n }) => (
          <CommentEntry key={id} s={s} ui={ui} id={id} n={n} comment={comment} replies={all.filter(([, one]) => one.parent === id)} />
        ))}
      </ul>
    </>
  );
}

function PlanBeside({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  return (
    <PlanHere
      s={s}
      ui={ui}
      binding={{
        pins: comment_pins(s),
        onTap: (place, node) =>
          s.may("comment") &&
          ui.set({
            isWriting: true,
            parent: null,
            ...(node && s.nameOf(node) !== node ? { selected: node, place: null } : { selected: null, place }),
          }),
      }}
    />
  );
}

export function Ideas({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  return (
    <>
      <Title>{t(ui.part === "comments" ? "ideas_comments" : "ideas_proposals")}</Title>
      <Segments
        label={t("tab_ideas")}
        value={ui.part}
        onChange={(part) => ui.set({ part, isWriting: false })}
        choices={[
          { id: "comments", text: t("ideas_comments") },
          { id: "proposals", text: t("ideas_proposals") },
        ]}
      />
      {ui.part === "comments" ? <Comments s={s} ui={ui} /> : <Proposals s={s} ui={ui} />}
    </>
  );
}
