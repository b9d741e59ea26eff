// The address of the room as a QR code, which the server draws: dark on light in every scheme of colours, as cameras expect.
import type { JSX } from "preact";
import { t } from "./words";

export function CodePicture({ code, address }: { code: string; address: string }): JSX.Element | null {
  if (code === "") return null; // it comes with the room
  return <img class="qr" src={`/qr/${code}.svg`} alt={t("qr_of", { address })} />;
}
