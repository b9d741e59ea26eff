// The minutes as files, one button for each.
import type { JSX } from "preact";
import { kMinutes, minutes_form, zone_here } from "../minutes";
import { Key, t } from "./words";
import { saved_as } from "../files/asking";
import { Props, SaidOfFile, useFile } from "../files/saving";

export function MinutesFiles({ room, token }: Props): JSX.Element {
  const { said, get } = useFile("minutes");
  return (
    <>
      <div class="row">
        {Object.entries(kMinutes).map(([what, file]) => (
          <button key={what} class="quiet" aria-disabled={said?.state === "making"} onClick={() => void get(minutes_form(room, token, file, zone_here()), saved_as(room, file))}>
            {t(`minutes_of_${what}` as Key)}
          </button>
        ))}
      </div>
      <SaidOfFile said={said} />
    </>
  );
}
