// Files to save: how one is asked for and told of.
import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { file_from_server } from "./asking";
import { t } from "./words";

export const ask: typeof fetch = (...what) => window.fetch(...what);

function save(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // Some browsers begin to read only after the click.
  window.setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/// Of the person who asks.
export interface Props {
  room: string;
  token: string;
}

interface Said {
  state: "making" | "saved" | "failed";
  text: string;
  notes: string[];
}

/// Asks for one file at a time, saves it, and says how that went.
export function useFile(what: "minutes" | "export"): { said: Said | null; get(form: Record<string, string>, name: string): Promise<void> } {
  const [said, say] = useState<Said | null>(null);
  const get = async (form: Record<string, string>, name: string): Promise<void> => {
    if (said?.state === "making") return;
    say({ state: "making", text: t("files_making"), notes: [] });
    const got = await file_from_server(what, form, ask);
    if (!("blob" in got)) return say({ state: "failed", text: t(got.why, { why: got.text }), notes: [] });
    save(got.blob, name);
    say({ state: "saved", text: t("files_saved", { file: name }), notes: got.notes });
  };
  return { said, get };
}

export function SaidOfFile({ said }: { said: Said | null }): JSX.Element {
  return (
    <div role="status" class="stack">
      <p class={said?.state === "failed" ? "notice" : "small"}>{said?.text ?? ""}</p>
      {said && said.notes.length > 0 ? (
        <ul class="small">
          {said.notes.map((note) => (
            <li key={note}>{note}</li>
          ))}
        </ul>
      ) : null}
    </div>
  );
}
