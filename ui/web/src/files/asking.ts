// Files that the server makes for one person: the minutes, and the plan in the formats of other programs.
import type { Key } from "./words";

/// One way in which a format can be wanted otherwise.
export interface FormatOption {
  id: string;
  doc: string;
  kind: "number" | "integer" | "boolean" | "text" | "choice";
  default: string | number | boolean;
  unit?: string;
  minimum?: number;
  maximum?: number;
  choices?: { id: string; doc: string }[];
}
export interface Format {
  id: string;
  label: string;
  doc: string;
  ending: string;
  options: FormatOption[];
}

/// The name under which a file is saved: those of several rooms may lie in one folder.
export const saved_as = (room: string, file: string): string => `${room}-${file.replace(/^.*\//, "")}`;

export interface MadeFile {
  blob: Blob;
  notes: string[]; ///< what it cannot hold
}

const kWhy: Record<"minutes" | "export", Record<"busy" | "right" | "failed", Key>> = {
  minutes: { busy: "minutes_busy", right: "minutes_right", failed: "minutes_failed" },
  export: { busy: "export_busy", right: "export_right", failed: "export_failed" },
};

/// Posts a form, so that the token stands in no address. The file, or why there is none: a sentence, and what the server says.
export async function file_from_server(
  what: "minutes" | "export",
  form: Record<string, string>,
  ask: typeof fetch,
): Promise<MadeFile | { why: Key; text: string }> {
  try {
    const answer = await ask(`/${what}`, { method: "POST", body: new URLSearchParams(form) });
    if (answer.ok) {
      const notes = decodeURIComponent(answer.headers.get("notes") ?? "");
      return { blob: await answer.blob(), notes: notes === "" ? [] : notes.split("\n") };
    }
    const why = answer.status === 409 ? "busy" : answer.status === 403 ? "right" : "failed";
    return { why: kWhy[what][why], text: (await answer.text()).trim() };
  } catch {
    return { why: "files_offline", text: "" };
  }
}

/// All formats; null where the server does not answer.
export async function formats_of_server(ask: typeof fetch): Promise<Format[] | null> {
  try {
    const answer = await ask("/formats");
    return answer.ok ? ((await answer.json()) as Format[]) : null;
  } catch {
    return null;
  }
}

/// The form that asks for the plan. Only what differs from the defaults is said.
export function export_form(room: string, token: string, format: Format, wanted: Record<string, string>): Record<string, string> {
  const form: Record<string, string> = { room, token, format: format.id };
  for (const option of format.options) {
    const value = wanted[option.id];
    if (value !== undefined && value !== option_text(option.default)) form[`option.${option.id}`] = value;
  }
  return form;
}

/// A value as the field of a form has it.
export const option_text = (value: string | number | boolean): string => (typeof value === "boolean" ? (value ? "yes" : "no") : String(value));

/// `model_scale` as people read it.
export const option_name = (id: string): string => id.charAt(0).toUpperCase() + id.slice(1).replace(/_/g, " ");
