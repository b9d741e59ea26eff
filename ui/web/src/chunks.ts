// Scripts that come only when somebody asks for what they do.
import type { show } from "./files/show";
import type { Picture } from "./space/picture";

// The build fills in the addresses.
declare const CHUNKS: { space: string; files: string };

interface Scripts {
  space: { Picture: typeof Picture };
  files: { show: typeof show };
}

const coming: { [name: string]: Promise<unknown> | undefined } = {};
let failures = 0;

/// What did not come is asked for again by the next who wants it: under another name, because browsers remember what failed.
export function script<Name extends keyof Scripts>(name: Name): Promise<Scripts[Name]> {
  const known = coming[name] as Promise<Scripts[Name]> | undefined;
  if (known) return known;
  const made = import(failures > 0 ? `${CHUNKS[name]}#${failures}` : CHUNKS[name]) as Promise<Scripts[Name]>;
  coming[name] = made;
  made.catch(() => {
    coming[name] = undefined;
    failures += 1;
  });
  return made;
}
