// Other addresses at which the room may be found, and the links that open the same seat there.
import type { Json } from "./wire";

// An address of one computer alone, which no other can open.
export const is_local = (host: string): boolean => /^(localhost|127\..*|\[::1\])$/.test(host);

/// Those of the addresses that the server has told of that this page may lead to. `here`: the origin of the page. What is no
/// address of a web server, and what is less protected than this page, is left out: the link carries the key of the seat.
export function other_places(told: Json | undefined, here: string): string[] {
  const own = new URL(here),
    found: string[] = [];
  for (const text of Array.isArray(told) ? told : []) {
    if (typeof text !== "string" || !/^https?:\/\/[^/?#@\\\s]+$/.test(text)) continue;
    let url: URL;
    try {
      url = new URL(text);
    } catch {
      continue;
    }
    const isWorse = own.protocol === "https:" && url.protocol !== "https:";
    const isElsewhere = is_local(url.hostname) && !is_local(own.hostname);
    if (url.origin !== own.origin && !isWorse && !isElsewhere && !found.includes(url.origin)) found.push(url.origin);
  }
  return found;
}

/// The page of the room at another address. The key stands behind #, which browsers send to nobody.
/// `waiting`: what is not answered yet, packed.
export function link_to(
  place: string,
  room: string,
  who: { token: string; invite: string | null; isBeamer?: boolean; waiting?: string | null },
): string {
  const parts = [
    ...(who.invite === null ? [] : [`k=${who.invite}`]),
    `t=${who.token}`,
    ...(who.waiting ? [`q=${who.waiting}`] : []),
    ...(who.isBeamer ? ["beamer"] : []),
  ];
  return `${place}/${encodeURIComponent(room)}#${parts.join("&")}`;
}
