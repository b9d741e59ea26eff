// The sentences of files in Dutch.
import type { Text } from "../../words";
import type { FilesKey } from "./en";

export const nl: Record<FilesKey, Text> = {
  minutes_busy: "Het verslag wordt net voor iemand anders gemaakt. Probeer het zo meteen opnieuw.",
  minutes_right: "Alleen wie een ruimte leidt, krijgt het verslag.",
  minutes_failed: "Het verslag is niet gemaakt. De server zegt: {why}",
  files_making: "Het bestand wordt gemaakt …",
  files_saved: "{file} is opgeslagen.",
  files_offline: "De server antwoordt niet. Probeer het opnieuw als hij bereikbaar is.",
  export_format: "Formaat",
  export_options: "Opties",
  export_save: "Bestand opslaan",
  export_busy: "Er wordt net een bestand voor iemand anders gemaakt. Probeer het zo meteen opnieuw.",
  export_right: "Alleen wie een ruimte leidt en de ontwerpers krijgen bestanden van het plan.",
  export_failed: "Het bestand is niet gemaakt. De server zegt: {why}",
};
