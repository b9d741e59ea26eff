// The page: finds the room in the address, opens the connection, and shows the screen that is wanted.
import "./english";
import { render } from "preact";
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { browser_world, early_run, keep, kept, socket_address, speak, tab_keep, tab_kept, wanted_language } from "./browser";
import { part } from "./chunks";
import { Announcer, Avatar, Icon, IconName, Moved, Notices, Sheet, StatusLine, Title } from "./parts";
import { Refusals } from "./refusals";
import { unpacked } from "./handover";
import { kFirstViews } from "./hello";
import { Beamer } from "./screens/beamer";
import { Card } from "./screens/card";
import { Form } from "./screens/form";
import { Ideas } from "./screens/ideas";
import { CodeScreen, Join, LanguageChoice, Message } from "./screens/join";
import { LargeCode } from "./screens/codes";
import { Now } from "./screens/now";
import { OpenMinutes } from "./screens/open_minutes";
import { Part } from "./screens/part";
import { PlanScreen } from "./screens/plan_screen";
import { Votes } from "./screens/votes";
import { at_door, pens_asked, proposals_waiting } from "./screens/waiting";
import { tab_of_pens } from "./pens";
import { Queue } from "./queue";
import { PlanOrSpace } from "./space";
import { Session } from "./session";
import { Tab, Ui, useWatched, useWide } from "./ui";
import { Wifi, wifi_of_address } from "./wifi";
import { keep_wifi } from "./wifi_kept";
import { Key, Language, best_language, language_now, locale, t } from "./words";

interface Address {
  code: string;
  invite: string | null;
  token: string | null; ///< of a seat that was taken at another address of the room
  waiting: string | null; ///< what had no answer there, packed
  wifi: Wifi | null; ///< for a beamer on a computer of its own
  isBeamer: boolean;
  language: Language | null;
}

// The fragment never leaves the browser. It goes from the address bar at once, so that nobody passes an invitation or the key of
// their seat on by showing it.
function read_address(): Address {
  const code = decodeURIComponent(window.location.pathname.split("/")[1] ?? "").toUpperCase();
  const parts = window.location.hash.replace(/^#/, "").split("&");
  const value = (name: string): string | null => parts.find((part) => part.startsWith(`${name}=`))?.slice(name.length + 1) ?? null;
  const language = value("lang"),
    invite = value("k"),
    token = value("t"),
    waiting = value("q"),
    wifi = wifi_of_address(value("w") ?? "");
  const isBeamer = parts.includes("beamer");
  if (invite !== null || token !== null || waiting !== null || wifi !== null) window.history.replaceState(null, "", window.location.pathname + (isBeamer ? "#beamer" : ""));
  return { code, invite, token, waiting, wifi, isBeamer, language: language === null ? null : best_language([language]) };
}

const kIconOf: Partial<Record<Tab, IconName>> = { now: "now", plan: "plan", card: "card", votes: "votes", ideas: "ideas", lead: "lead" };

function tabs_of(s: Session): Tab[] {
  const tabs: Tab[] = ["now", "plan"],
    { card, votes } = s.views;
  if (s.you?.role === "facilitator") tabs.unshift("lead");
  if ((card.goals ?? []).length > 0 || (card.controls ?? []).length > 0) tabs.push("card");
  if (Object.keys(votes).length > 0) tabs.push("votes");
  tabs.push("ideas");
  return tabs;
}

function Navigation({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const isDue = (tab: Tab): boolean =>
    tab === "votes"
      ? Object.entries(s.views.votes).some(([id, vote]) => vote.open && !s.hasVoted(id, vote))
      : tab === "lead" && proposals_waiting(s).length + at_door(s).length + pens_asked(s).length > 0;
  return (
    <nav aria-label={t("navigation")}>
      {tabs_of(s).map((tab) => (
        <button key={tab} aria-current={ui.tab === tab ? "page" : undefined} onClick={() => ui.go(tab)}>
          <Icon name={kIconOf[tab] ?? "now"} />
          <span>{t(`tab_${tab}` as Key)}</span>
          {isDue(tab) ? <i class="dot" aria-hidden="true" /> : null}
        </button>
      ))}
    </nav>
  );
}

function screen_of(s: Session, ui: Ui, isWide: boolean): JSX.Element {
  switch (ui.tab) {
    case "plan":
      return <PlanScreen s={s} ui={ui} isWide={isWide} />;
    case "card":
      return <Card s={s} ui={ui} />;
    case "votes":
      return <Votes s={s} ui={ui} />;
    case "ideas":
      return <Ideas s={s} ui={ui} />;
    case "lead":
      // Somebody may have got another role meanwhile.
      if (s.you?.role !== "facilitator") return <Now s={s} ui={ui} />;
      return (
        <>
          <Title>{t("tab_lead")}</Title>
          <Part s={s} ui={ui} name="lead" />
        </>
      );
    case "form":
      return <Form s={s} ui={ui} />;
    default:
      return <Now s={s} ui={ui} />;
  }
}

// Who leads has the minutes on a screen of their own; who only watches has none.
const took_part = ({ you, views: { room } }: Session): boolean =>
  you !== null && you.role !== "facilitator" && you.role !== "viewer" && room.seats?.[you.seat]?.waits !== true;

function Frame({ s, ui, onLanguage }: { s: Session; ui: Ui; onLanguage(one: Language): void }): JSX.Element {
  const isWide = useWide(),
    [isYou, setYou] = useState(false),
    you = s.you;
  useEffect(() => s.want("comments", "proposals", "drafts"), []);
  if (ui.isCodeLarge) return <LargeCode s={s} onClose={() => ui.set({ isCodeLarge: false })} />;
  return (
    <div class={`frame ${isWide ? "wide" : ""} ${ui.tab === "lead" ? "leads" : ""}`}>
      <header class="top">
        <div class="grow">
          <p class="room">{s.views.room.title}</p>
          <StatusLine s={s} />
        </div>
        {you ? (
          <button class="me" aria-label={`${t("you")}: ${you.name}`} onClick={() => setYou(true)}>
            <Avatar name={you.name} colour={you.colour} />
          </button>
        ) : null}
      </header>
      <Navigation s={s} ui={ui} />
      {isWide ? (
        <aside aria-label={t("plan")}>
          <PlanOrSpace
            s={s}
            binding={ui.binding ?? { pins: [], onTap: (_, node) => ui.set({ selected: node }) }}
            selected={ui.selected}
            label={14}
          />
        </aside>
      ) : null}
      <main key={ui.tab}>
        <Moved s={s} />
        <Notices s={s} />
        <Refusals
          s={s}
          toPens={() => {
            ui.isToPens = true;
            ui.go(tab_of_pens(s));
          }}
        />
        {s.views.room.closed ? (
          <p class="notice" role="status">
            <b>{t("closed_title")}.</b> {you?.role === "facilitator" ? t("closed_minutes", { tab: t("tab_lead") }) : t("closed")}
          </p>
        ) : null}
        {s.views.room.shares_minutes && took_part(s) ? <OpenMinutes s={s}>{t("minutes_home")}</OpenMinutes> : null}
        {screen_of(s, ui, isWide)}
      </main>
      {isYou && you ? (
        <Sheet title={you.name} onClose={() => setYou(false)}>
          <p class="faint">{t(`role_${you.role}` as Key)}</p>
          <LanguageChoice language={language_now()} onLanguage={onLanguage} />
          <h3>{t("consent_more")}</h3>
          <p>{t("consent_text", { name: you.name })}</p>
        </Sheet>
      ) : null}
    </div>
  );
}

function App({ s, ui, address }: { s: Session; ui: Ui; address: Address }): JSX.Element {
  const [isIn, setIn] = useState(kept(`joined/${address.code}`) !== null && s.connection.token !== null);
  const [, again] = useState(0);
  useWatched(s, ui);
  const change_language = (one: Language): void => {
    keep("language", one);
    void speak(one).then(() => {
      document.documentElement.lang = locale();
      again((count) => count + 1);
    });
  };
  const { stage } = s.connection,
    isLead = s.you?.role === "facilitator";
  // Who leads needs that page first: it comes while they read who they are.
  useEffect(() => {
    if (isLead && !address.isBeamer) part("lead", language_now()).catch(() => undefined);
  }, [isLead]);
  document.title = s.views.room.title ?? "BehaviourLinks";
  if (address.isBeamer) return <Beamer s={s} />;
  if (stage === "removed") return <Message title={t("removed_title")} text={t("removed")} />;
  if (stage === "old")
    return <Message title={t("old_title")} text={t("old")} action={t("reload")} onAction={() => window.location.reload()} />;
  if (stage === "door") return s.isInvited ? (
      <Message title={t("door_invite_title")} text={t("door_invite")} />
    ) : (
      <Message title={t("door_title")} text={t("door")} s={s} />
    );
  const go = (): void => {
    keep(`joined/${address.code}`, "1");
    ui.tab = s.you?.role === "facilitator" ? "lead" : "now";
    setIn(true);
  };
  return (
    <>
      {isIn ? (
        <Frame s={s} ui={ui} onLanguage={change_language} />
      ) : (
        <Join s={s} language={language_now()} onLanguage={change_language} onGo={go} />
      )}
      <Announcer s={s} />
    </>
  );
}

// The marked language of the tests is English to everybody else.
function language_for_server(chosen: Language | null): string {
  const wanted = wanted_language(chosen);
  return wanted === "xx" ? "en" : wanted;
}

function start(): void {
  const root = document.getElementById("page");
  if (!root) return;
  const address = read_address();
  // Words of another language may still be on their way: the connection does not wait for them. The first screen is a task of its own,
  // so that a slow phone stays awake to touches, and to messages, between the two.
  const show = (screen: () => JSX.Element): void =>
    void speak(wanted_language(address.language)).then(() =>
      window.setTimeout(() => {
        document.documentElement.lang = locale();
        root.textContent = "";
        render(screen(), root);
      }),
    );
  if (address.code === "")
    return show(() => <CodeScreen onCode={(code) => window.location.assign(`/${encodeURIComponent(code)}`)} />);
  if (address.wifi) keep_wifi(address.code, address.wifi);
  if (address.isBeamer) document.documentElement.classList.add("on-beamer");
  const views = kFirstViews[address.isBeamer ? "beamer" : "page"];
  const world = browser_world(socket_address());
  // Each invitation is a seat of its own, with its own key and its own queue: a page never speaks for another of its seats.
  const base = `bl1/${address.code}/${address.isBeamer ? "beamer/" : ""}`;
  const invite = address.invite ?? tab_kept(`${base}invite`) ?? world.store.get(`${base}invite`);
  const prefix = invite === null ? `${base}code/` : `${base}by-${invite}/`;
  const runKey = `${prefix}run`;
  if (invite !== null) {
    tab_keep(`${base}invite`, invite);
    world.store.set(`${base}invite`, invite);
  }
  // A link of this page at another address brings the seat along. A seat that is here already stays.
  const tokenKey = `${prefix}token`;
  if (address.token !== null && world.store.get(tokenKey) === null) world.store.set(tokenKey, address.token);
  // What waited there was said by the seat of the link.
  const brought = address.token !== null && address.waiting !== null ? unpacked(address.waiting) : [];
  const isSame = world.store.get(tokenKey) === address.token;
  if (isSame) Queue.bring(world.store, prefix, brought, world.now());
  const session = new Session(
    world,
    {
      room: address.code,
      prefix,
      run: tab_kept(runKey) ?? early_run(),
      lang: language_for_server(address.language),
      views,
      invite,
      here: window.location.origin,
      isBeamer: address.isBeamer,
    },
    (run) => tab_keep(runKey, run),
    () => window.location.reload(),
  );
  if (!isSame) session.refuseBrought(brought);
  const ui = new Ui();
  // Others may know what somebody looks at: what stands in the scene itself, not plots and streets.
  ui.watch(() => session.connection.presence.change({ holds: ui.selected !== null && !ui.selected.includes("/") ? [ui.selected] : [] }));
  const turned = (): void => (document.visibilityState === "visible" ? session.connection.wake() : session.connection.sleep());
  document.addEventListener("visibilitychange", turned);
  window.addEventListener("pageshow", () => session.connection.wake());
  window.addEventListener("online", () => session.connection.wake());
  window.addEventListener("pagehide", () => session.connection.leave());
  session.connection.start();
  show(() => <App s={session} ui={ui} address={address} />);
}

// A task of its own: to read the script takes a slow phone long enough, and touches and messages may come in between.
window.setTimeout(start);
