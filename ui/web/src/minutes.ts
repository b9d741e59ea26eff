// The minutes of a session: from the server, or by a command for the computer that has the session file.
import type { Key } from "./words";

/// What the server makes, by what it is called on the page.
export const kMinutes = {
  page: "minutes.html",
  decisions: "decisions.csv",
  comments: "comments.csv",
  votes: "votes.csv",
  log: "log.jsonl",
  scene: "scenes/end.json",
};

/// The name under which a file is saved: those of several rooms may lie in one folder.
export const saved_as = (room: string, file: string): string => `${room}-${file.replace(/^.*\//, "")}`;

/// How far the clocks of this device are ahead of UTC, as the server reads it; `behind`: what Date says [min].
export function zone_text(behind: number): string {
  if (behind === 0) return "UTC";
  const minutes = Math.abs(behind),
    two = (count: number): string => String(count).padStart(2, "0");
  return `${behind > 0 ? "-" : "+"}${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}

/// The form that asks for a file. It is posted, so that the token stands in no address.
export const minutes_form = (room: string, token: string, file: string, zone: string): Record<string, string> => ({ room, token, file, zone });

/// The file, or why there is none: a sentence, and what the server says.
export async function minutes_from_server(form: Record<string, string>, ask: typeof fetch): Promise<Blob | { why: Key; text: string }> {
  try {
    const answer = await ask("/minutes", { method: "POST", body: new URLSearchParams(form) });
    if (answer.ok) return await answer.blob();
    const why: Key = answer.status === 409 ? "minutes_busy" : answer.status === 403 ? "minutes_right" : "minutes_failed";
    return { why, text: (await answer.text()).trim() };
  } catch {
    return { why: "minutes_offline", text: "" };
  }
}

/// One word of a command line, whatever stands in it.
export function shell_word(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/// The command, and the page that it writes. Each session has a folder of its own: minutes are never written over those of another.
export function minutes_of(file: string): { command: string; page: string } {
  const folder = `${file.replace(/\.blsession$/, "")}-minutes`;
  return { command: `./bl minutes ${shell_word(file)} --out ${shell_word(folder)}`, page: `${folder}/minutes.html` };
}
