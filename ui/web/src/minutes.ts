// The minutes of a session: from the server, or by a command for the computer that has the session file.

/// What the server makes, by what it is called on the page.
export const kMinutes = {
  page: "minutes.html",
  decisions: "decisions.csv",
  comments: "comments.csv",
  votes: "votes.csv",
  log: "log.jsonl",
  scene: "scenes/end.json",
};

/// How far the clocks of this device are ahead of UTC, as the server reads it; `behind`: what Date says [min].
export function zone_text(behind: number): string {
  if (behind === 0) return "UTC";
  const minutes = Math.abs(behind),
    two = (count: number): string => String(count).padStart(2, "0");
  return `${behind > 0 ? "-" : "+"}${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}

export const zone_here = (): string => zone_text(new Date().getTimezoneOffset());

/// The form that asks for a file.
export const minutes_form = (room: string, token: string, file: string, zone: string): Record<string, string> => ({ room, token, file, zone });

/// One word of a command line, whatever stands in it.
export function shell_word(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/// The command, and the page that it writes. Each session has a folder of its own: minutes are never written over those of another.
export function minutes_of(file: string): { command: string; page: string } {
  const folder = `${file.replace(/\.blsession$/, "")}-minutes`;
  return { command: `./bl minutes ${shell_word(file)} --out ${shell_word(folder)}`, page: `${folder}/minutes.html` };
}
