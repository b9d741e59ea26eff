// The sentences of files in German.
import type { Text } from "../../words";
import type { FilesKey } from "./en";

export const de: Record<FilesKey, Text> = {
  minutes_busy: "Das Protokoll wird gerade für jemand anderen gemacht. Versuchen Sie es gleich noch einmal.",
  minutes_right: "Nur wer einen Raum leitet, bekommt sein Protokoll.",
  minutes_failed: "Das Protokoll wurde nicht gemacht. Der Server sagt: {why}",
  files_making: "Die Datei wird gemacht …",
  files_saved: "{file} wurde gespeichert.",
  files_offline: "Der Server antwortet nicht. Versuchen Sie es wieder, wenn er erreichbar ist.",
  export_format: "Format",
  export_options: "Optionen",
  export_save: "Datei speichern",
  export_busy: "Gerade wird eine Datei für jemand anderen gemacht. Versuchen Sie es gleich wieder.",
  export_right: "Nur wer einen Raum leitet und die Entwerfenden bekommen Dateien des Plans.",
  export_failed: "Die Datei wurde nicht gemacht. Der Server sagt: {why}",
};
