// The Wi-Fi of the room, as its facilitator has typed it: kept in the browsers of the facilitator and the beamer, and nowhere else.
import { useEffect, useState } from "preact/hooks";
import { keep, kept } from "./browser";

export interface Wifi {
  name: string;
  password: string; ///< empty: the network is open
}

/// What phones read from a QR code to join a network (ZXing, "Barcode contents"). Four characters have a meaning in it.
export function wifi_text({ name, password }: Wifi): string {
  const plain = (text: string): string => text.replace(/[\\;,:"]/g, "\\$&");
  return `WIFI:T:${password === "" ? "nopass" : "WPA"};S:${plain(name)};${password === "" ? "" : `P:${plain(password)};`};`;
}

/// For the address of the beamer, behind the #: letters, digits and `%`.
export const wifi_to_address = (wifi: Wifi): string => encodeURIComponent(JSON.stringify([wifi.name, wifi.password]));

export function wifi_of_address(text: string): Wifi | null {
  try {
    const [name, password] = JSON.parse(decodeURIComponent(text)) as unknown[];
    return typeof name === "string" && typeof password === "string" && name !== "" ? { name, password } : null;
  } catch {
    return null;
  }
}

const key_of = (room: string): string => `wifi/${room}`;

export function keep_wifi(room: string, wifi: Wifi): void {
  keep(key_of(room), wifi_to_address(wifi));
}

/// The Wi-Fi, and a way to change it. A beamer in another window of the same browser follows at once.
export function useWifi(room: string): [Wifi | null, (wifi: Wifi) => void] {
  const read = (): Wifi | null => wifi_of_address(kept(key_of(room)) ?? "");
  const [wifi, set] = useState(read);
  useEffect(() => {
    const again = (): void => set(read());
    again();
    window.addEventListener("storage", again);
    return () => window.removeEventListener("storage", again);
  }, [room]);
  return [
    wifi,
    (next) => {
      keep_wifi(room, next);
      set(next.name === "" ? null : next);
    },
  ];
}
