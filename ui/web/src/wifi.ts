// The Wi-Fi of a room as a text: for the cameras of phones, and for the address of the beamer.

export interface Wifi {
  name: string;
  password: string; ///< empty: the network is open
}

/// What phones read from a QR code to join a network (ZXing, "Barcode contents"). Four characters have a meaning in it.
export function wifi_text({ name, password }: Wifi): string {
  const plain = (text: string): string => text.replace(/[\\;,:"]/g, "\\$&");
  return `WIFI:T:${password === "" ? "nopass" : "WPA"};S:${plain(name)};${password === "" ? "" : `P:${plain(password)};`};`;
}

/// What a router takes as a password: 8 to 63 signs of ASCII (IEEE 802.11, annex J); an open network has none.
export const is_password = (text: string): boolean => text === "" || /^[ -~]{8,63}$/.test(text);

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
