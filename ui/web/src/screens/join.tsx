// The first screen: which room this is, how its plan looks, and who one is in it.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { Avatar, Icon, Moved, Sheet, StatusLine, Title } from "../parts";
import { Plan } from "../plan";
import type { Session } from "../session";
import { useLater } from "../ui";
import { Language, kLanguages, kNames, t } from "../words";

export function Join({
  s,
  language,
  onLanguage,
  onGo,
}: {
  s: Session;
  language: Language;
  onLanguage(one: Language): void;
  onGo(): void;
}): JSX.Element {
  const [isReading, read] = useState(false),
    isPainted = useLater();
  const you = s.you;
  return (
    <div class="join">
      <main>
        <Title>{s.views.room.title ?? s.views.room.code ?? "…"}</Title>
        <div class="picture">{isPainted ? <Plan s={s} binding={null} selected={null} isStill /> : null}</div>
        <div class="who">
          {you ? (
            <>
              <Avatar name={you.name} colour={you.colour} />
              <p>
                <span class="faint">{t("you_are")}</span>
                <b class="self">{you.name}</b>
              </p>
            </>
          ) : (
            <p class="faint">{t("connecting")}</p>
          )}
        </div>
        <Moved s={s} />
        <button class="main" disabled={!you} onClick={onGo}>
          {t("go")}
          <Icon name="right" />
        </button>
        <div class="consent">
          <p class="small">{t("consent", { name: you?.name ?? "…" })}</p>
          <button class="link" onClick={() => read(true)}>
            {t("consent_more")}
          </button>
        </div>
        <div class="foot">
          <LanguageChoice language={language} onLanguage={onLanguage} />
          <StatusLine s={s} />
        </div>
      </main>
      {isReading ? (
        <Sheet title={t("consent_more")} onClose={() => read(false)}>
          <p>{t("consent_text", { name: you?.name ?? "…" })}</p>
        </Sheet>
      ) : null}
    </div>
  );
}

export function LanguageChoice({ language, onLanguage }: { language: Language; onLanguage(one: Language): void }): JSX.Element {
  return (
    <label class="language">
      <span class="unseen">{t("your_language")}</span>
      <select value={language} onChange={(event) => onLanguage(event.currentTarget.value as Language)}>
        {language === "xx" ? <option value="xx">xx</option> : null}
        {kLanguages.map((one) => (
          <option key={one} value={one} lang={one}>
            {kNames[one]}
          </option>
        ))}
      </select>
    </label>
  );
}

/// The address without a code: where to type it.
export function CodeScreen({ onCode }: { onCode(code: string): void }): JSX.Element {
  const [code, set] = useState("");
  return (
    <main class="alone">
      <Title>{t("bad_code_title")}</Title>
      <p>{t("bad_code")}</p>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (code.trim()) onCode(code.trim().toUpperCase());
        }}
      >
        <label class="field">
          <span>{t("code")}</span>
          <input
            class="letters"
            value={code}
            autocapitalize="characters"
            autocomplete="off"
            spellcheck={false}
            maxLength={8}
            onInput={(event) => set(event.currentTarget.value)}
          />
        </label>
        <button class="main" type="submit">
          {t("go")}
          <Icon name="right" />
        </button>
      </form>
    </main>
  );
}

/// Where nothing can be done here: why, and what to do next.
export function Message({
  title,
  text,
  action,
  onAction,
  s,
}: {
  title: string;
  text: string;
  action?: string;
  onAction?(): void;
  s?: Session;
}): JSX.Element {
  return (
    <main class="alone">
      <Title>{title}</Title>
      <p>{text}</p>
      {action ? (
        <button class="main" onClick={onAction}>
          {action}
        </button>
      ) : null}
      {s ? <StatusLine s={s} /> : null}
    </main>
  );
}
