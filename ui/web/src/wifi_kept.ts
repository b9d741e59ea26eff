// The Wi-Fi of the room, as its facilitator has typed it: kept in the browsers of the facilitator and the beamer, and nowhere else.
import { useEffect, useState } from "preact/hooks";
import { keep, kept } from "./browser";
import { Wifi, wifi_of_address, wifi_to_address } from "./wifi";

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
