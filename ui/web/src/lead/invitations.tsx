// How people get in: the address, the large code, and the keys of invitations.
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { MarkState, Segments, Sure } from "../parts";
import { is_local } from "../places";
import { WifiPicture } from "../qr_picture";
import { join_address } from "../screens/codes";
import type { Session } from "../session";
import { is_password, wifi_to_address } from "../wifi";
import { useWifi } from "../wifi_kept";
import type { Ui } from "../ui";
import type { Door, Role } from "../wire";
import { Key, t } from "./words";

/// In the order in which they are offered.
export const kRoles: Role[] = ["facilitator", "designer", "stakeholder", "participant", "viewer", "recorder"];

// A page without TLS may not use the clipboard itself, so the text is selected and copied as by hand.
export function AddressRow({ name, address }: { name: string; address: string }): JSX.Element {
  const field = useRef<HTMLInputElement>(null),
    [isCopied, set] = useState("");
  const copy = (): void => {
    field.current?.select();
    if (document.execCommand("copy")) set(address);
  };
  const said = t(isCopied === address ? "lead_copied" : "lead_copy");
  return (
    <div class="pick">
      <label class="field">
        <span>{name}</span>
        <input ref={field} readOnly value={address} autocomplete="off" spellcheck={false} onFocus={(event) => event.currentTarget.select()} />
      </label>
      <button class="quiet" aria-label={`${said}: ${name}`} onClick={copy}>
        {said}
      </button>
    </div>
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
            keys[role] === undefined ? null : (
              <li key={role}>
                <AddressRow name={t(`role_${role}` as Key)} address={`${join_address(s)}#k=${keys[role]}`} />
              </li>
            ),
          )}
        </ul>
      </details>
      <Sure text={t("lead_keys_sure")} yes={t("lead_keys_new")} onYes={() => s.event("renew_keys", {}, { mark: "lead/keys" })}>
        {t("lead_keys_new")}
      </Sure>
    </section>
  );
}

/// The Wi-Fi of the room, for those who are not in it yet.
export function WifiPart({ s }: { s: Session }): JSX.Element {
  const code = s.views.room.code ?? "",
    [wifi, change] = useWifi(code),
    { name, password } = wifi ?? { name: "", password: "" };
  return (
    <details>
      <summary>{t("wifi_title")}</summary>
      <p class="small">{t("wifi_text")}</p>
      <div class="pair">
        <label class="field">
          <span>{t("wifi_name")}</span>
          <input
            value={name}
            maxLength={32}
            autocomplete="off"
            autocapitalize="off"
            spellcheck={false}
            onInput={(event) => change({ name: event.currentTarget.value, password })}
          />
        </label>
        <label class="field">
          <span>{t("wifi_password")}</span>
          <input
            value={password}
            disabled={name === ""}
            maxLength={63}
            autocomplete="off"
            autocapitalize="off"
            spellcheck={false}
            onInput={(event) => change({ name, password: event.currentTarget.value })}
          />
        </label>
      </div>
      {is_password(password) ? null : (
        <p class="missing" role="status">
          {t("wifi_password_hint")}
        </p>
      )}
      {wifi && is_password(password) ? (
        <>
          <WifiPicture wifi={wifi} />
          <AddressRow name={t("wifi_beamer")} address={`${join_address(s)}#beamer&w=${wifi_to_address(wifi)}`} />
        </>
      ) : null}
    </details>
  );
}

/// How people get in, which comes first: the code, the Wi-Fi, and the door.
export function JoinPart({ s, ui }: { s: Session; ui: Ui }): JSX.Element {
  const { room } = s.views,
    doors: Door[] = ["open", "asks", "shut"];
  return (
    <section class="panel" id="lead-join">
      <h2>{t("lead_code")}</h2>
      <p>{t("lead_code_text")}</p>
      <p class="bigcode">{room.code}</p>
      <p class="small">{join_address(s)}</p>
      {is_local(window.location.hostname) ? (
        <p class="notice" role="status">
          {t("lead_local")}
        </p>
      ) : null}
      <button class="quiet" onClick={() => ui.set({ isCodeLarge: true })}>
        {t("lead_big_code")}
      </button>
      <WifiPart s={s} />
      <header class="row spread">
        <h3>{t("lead_door")}</h3>
        <MarkState s={s} mark="lead/door" />
      </header>
      <Segments
        label={t("lead_door")}
        value={room.door ?? "open"}
        onChange={(door) => s.event("set_door", { door }, { mark: "lead/door" })}
        choices={doors.map((id) => ({ id, text: t(`door_${id}` as Key) }))}
      />
      <p class="small">{t(`door_${room.door ?? "open"}_text` as Key)}</p>
    </section>
  );
}
