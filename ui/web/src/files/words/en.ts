// The sentences of files in English; the other languages have the same keys.
import type { Text } from "../../words";

export const en = {
  minutes_busy: "The minutes are being made for somebody else. Try again in a moment.",
  minutes_right: "Only who leads a room gets its minutes.",
  minutes_failed: "The minutes were not made. The server says: {why}",
  files_making: "The file is being made …",
  files_saved: "{file} was saved.",
  files_offline: "The server does not answer. Try again when it can be reached.",
  export_format: "Format",
  export_options: "Options",
  export_save: "Save the file",
  export_busy: "A file is being made for somebody else. Try again in a moment.",
  export_right: "Only who leads a room, and its designers, get files of its plan.",
  export_failed: "The file was not made. The server says: {why}",
} satisfies Record<string, Text>;

export type FilesKey = keyof typeof en;
