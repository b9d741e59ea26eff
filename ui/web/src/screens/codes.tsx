// The codes that bring people in: the room's address, and its Wi-Fi where that is known.
import type { JSX } from "preact";
import { CodePicture, WifiPicture } from "../qr_picture";
import type { Session } from "../session";
import { useWifi } from "../wifi_kept";
import { t } from "../words";

/// The address that people open to join.
export function join_address(s: Session): string {
  return `${window.location.protocol}//${window.location.host}/${s.views.room.code ?? ""}`;
}

/// The two codes that a phone needs, beside each other: the Wi-Fi, where it is known, and the room.
export function Codes({ s }: { s: Session }): JSX.Element {
  const code = s.views.room.code ?? "",
    [wifi] = useWifi(code);
  return (
    <div class="codes">
      {wifi ? (
        <figure>
          <WifiPicture wifi={wifi} />
          <figcaption>
            <span>{t("wifi_join")}</span>
            <b>{wifi.name}</b>
            {wifi.password === "" ? null : <span class="password">{wifi.password}</span>}
          </figcaption>
        </figure>
      ) : null}
      <figure>
        <CodePicture code={code} address={join_address(s)} />
        <figcaption>
          <span>{t(wifi ? "wifi_then" : "beamer_join")}</span>
          <b class="address">
            {window.location.host}
            <wbr />/{code}
          </b>
        </figcaption>
      </figure>
    </div>
  );
}

export function LargeCode({ s, onClose }: { s: Session; onClose(): void }): JSX.Element {
  return (
    <main class="largecode">
      <h1 class="bigcode">{s.views.room.code}</h1>
      <Codes s={s} />
      <button class="quiet" onClick={onClose}>
        {t("close")}
      </button>
    </main>
  );
}
