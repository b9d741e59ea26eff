// QR codes, which the server draws: dark on light in every scheme of colours, as cameras expect.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { Wifi, wifi_text } from "./wifi";
import { t } from "./words";

export function CodePicture({ code, address }: { code: string; address: string }): JSX.Element | null {
  if (code === "") return null; // it comes with the room
  return <img class="qr" src={`/qr/${code}.svg`} alt={t("qr_of", { address })} />;
}

/// What joins a phone to the Wi-Fi. The text goes to the server as a form does, because an address would be kept in histories.
export function WifiPicture({ wifi }: { wifi: Wifi }): JSX.Element | null {
  const [picture, set] = useState<string | null>(null),
    text = wifi_text(wifi);
  useEffect(() => {
    let isWanted = true,
      made: string | null = null;
    const draw = async (): Promise<void> => {
      const answer = await window.fetch("/qr", { method: "POST", body: text });
      if (!isWanted || !answer.ok) return;
      made = URL.createObjectURL(new Blob([await answer.text()], { type: "image/svg+xml" }));
      set(made);
    };
    // While somebody types, not every letter is drawn. Without a connection the name and the password can still be read.
    const timer = window.setTimeout(() => void draw().catch(() => undefined), 300);
    return () => {
      isWanted = false;
      window.clearTimeout(timer);
      if (made !== null) URL.revokeObjectURL(made);
    };
  }, [text]);
  return picture === null ? null : <img class="qr" src={picture} alt={t("wifi_qr", { name: wifi.name })} />;
}
