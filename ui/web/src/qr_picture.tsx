// A QR code as a picture, dark on light in every scheme of colours, because cameras expect that.
import type { JSX } from "preact";
import { qr_code } from "./qr";
import { t } from "./words";

export function CodePicture({ text }: { text: string }): JSX.Element | null {
  const code = qr_code(text);
  if (!code) return null;
  const size = code.length + 8; // with the quiet border of four modules
  let path = "";
  code.forEach((row, y) =>
    row.forEach((dark, x) => {
      if (dark) path += `M${x + 4} ${y + 4}h1v1h-1z`;
    }),
  );
  return (
    <svg class="qr" viewBox={`0 0 ${size} ${size}`} role="img" aria-label={t("qr_of", { address: text })} shape-rendering="crispEdges">
      <rect width={size} height={size} fill="#fff" />
      <path d={path} fill="#000" />
    </svg>
  );
}
