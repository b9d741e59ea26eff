// The first message of a page. It is short and known early, so that it can go out before the rest of the script is here.
import type { ViewName } from "./wire";

/// What the first screens of a page and of a beamer show.
export const kFirstViews: Record<"page" | "beamer", ViewName[]> = {
  page: ["room", "plan", "figures", "card", "votes"],
  beamer: ["room", "plan", "figures", "votes", "comments", "proposals"],
};

export interface Greeting {
  room: string;
  run: string;
  isBeamer: boolean;
  token: string | null;
  invite: string | null;
  unacked: number;
  views: ViewName[];
  lang: string;
}

export function hello_of({ room, run, isBeamer, token, invite, unacked, views, lang }: Greeting): object {
  const who = token ? { token } : invite ? { invite } : {};
  return { t: "hello", room, run, kind: isBeamer ? "beamer" : "page", ...who, unacked, views, lang };
}
