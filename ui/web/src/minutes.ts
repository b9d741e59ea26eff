// How the minutes of a session are made, as a command for the computer that has its file.

/// One word of a command line, whatever stands in it.
export function shell_word(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/// The command, and the page that it writes. Each session has a folder of its own: minutes are never written over those of another.
export function minutes_of(file: string): { command: string; page: string } {
  const folder = `${file.replace(/\.blsession$/, "")}-minutes`;
  return { command: `./bl minutes ${shell_word(file)} --out ${shell_word(folder)}`, page: `${folder}/minutes.html` };
}
