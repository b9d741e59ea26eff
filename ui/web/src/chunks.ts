// Scripts that come only when somebody asks for what they do, with their words.
import type { show as show_files } from "./files/show";
import type { show as show_lead } from "./lead/show";
import type { Picture } from "./space/picture";
import type { Language, Words } from "./words";

// The build fills in the addresses. English words are part of the scripts.
declare const CHUNKS: {
  space: string;
  files: string;
  lead: string;
  words: Record<"files" | "lead", Record<string, string | undefined>>;
};

interface Parts {
  files: { show: typeof show_files };
  lead: { show: typeof show_lead };
}
export type PartName = keyof Parts;
interface Scripts extends Parts {
  space: { Picture: typeof Picture };
}

const coming: { [address: string]: Promise<unknown> | undefined } = {};
let failures = 0;

// What did not come is asked for again by the next who wants it: under another name, because browsers remember what failed.
function come(address: string): Promise<unknown> {
  const made = (coming[address] ??= import(failures > 0 ? `${address}#${failures}` : address));
  made.catch(() => {
    if (coming[address] !== made) return;
    coming[address] = undefined;
    failures += 1;
  });
  return made;
}

export const script = <Name extends keyof Scripts>(name: Name): Promise<Scripts[Name]> => come(CHUNKS[name]) as Promise<Scripts[Name]>;

/// A part of the page with a script of its own, and its words in a language; no words for one whose words it has.
export async function part<Name extends PartName>(name: Name, language: Language): Promise<{ script: Parts[Name]; own: Words | null }> {
  const address = CHUNKS.words[name][language];
  const [made, words] = await Promise.all([script(name), address ? (come(address) as Promise<Record<string, Words>>) : null]);
  return { script: made as Parts[Name], own: words?.[language] ?? null };
}
