// How people get in: the address, the large code, and the keys of invitations.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { MarkState, Sure } from "../parts";
import { CodePicture } from "../qr_picture";
import type { Session } from "../session";
import type { Role } from "../wire";
import { Key, t } from "../words";

/// In the order in which they are offered.
export const kRoles: Role[] = ["facilitator", "designer", "stakeholder", "participant", "viewer", "recorder"];

/// The address that people open to join.
export function join_address(s: Session): string {
  return `${window.location.protocol}//${window.location.host}/${s.views.room.code ?? ""}`;
}

// A page without TLS may not use the clipboard itself, so the text is selected and copied as by hand.
function KeyRow({ role, address }: { role: Role; address: string }): JSX.Element {
  const field = useRef<HTMLInputElement>(null),
    [isCopied, set] = useState("");
  const copy = (): void => {
    field.current?.select();
    if (document.execCommand("copy")) set(address);
  };
  const name = t(`role_${role}` as Key),
    said = t(isCopied === address ? "lead_copied" : "lead_copy");
  return (
    <li class="pick">
      <label class="field">
        <span>{name}</span>
        <input ref={field} readOnly value={address} autocomplete="off" spellcheck={false} onFocus={(event) => event.currentTarget.select()} />
      </label>
      <button class="quiet" aria-label={`${said}: ${name}`} onClick={copy}>
        {said}
      </button>
    </li>
  );
}

export function KeysPart({ s }: { s: Session }): JSX.Element {
  useEffect(() => s.want("keys"), []);
  const { keys } = s.views;
  return (
    <section class="panel">
      <header class="row spread">
        <h2>{t("lead_keys")}</h2>
        <MarkState s={s} mark="lead/keys" />
      </header>
      <p class="small">{t("lead_keys_text")}</p>
      <details>
        <summary>{t("lead_keys_show")}</summary>
        <ul class="rows keys">
          {kRoles.map((role) =>
            keys[role] === undefined ? null : <KeyRow key={role} role={role} address={`${join_address(s)}#k=${keys[role]}`} />,
          )}
        </ul>
      </details>
      <Sure text={t("lead_keys_sure")} yes={t("lead_keys_new")} onYes={() => s.event("renew_keys", {}, { mark: "lead/keys" })}>
        {t("lead_keys_new")}
      </Sure>
    </section>
  );
}

export function LargeCode({ s, onClose }: { s: Session; onClose(): void }): JSX.Element {
  return (
    <main class="largecode">
      <CodePicture code={s.views.room.code ?? ""} address={join_address(s)} />
      <h1 class="bigcode">{s.views.room.code}</h1>
      <p>{join_address(s)}</p>
      <button class="quiet" onClick={onClose}>
        {t("close")}
      </button>
    </main>
  );
}
