// Serves the built page and a mock room on one port, with the headers that the real server sends.
import { createHash } from "node:crypto";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { MockRoom } from "./mock_room.mjs";

const { WebSocketServer } = createRequire(new URL("../package.json", import.meta.url))("ws");
const folder = fileURLToPath(new URL("../../../build/web", import.meta.url));
// What stands in the page itself is allowed by its digest, as the real server does it.
function policy() {
  const page = readFileSync(join(folder, "index.html"), "utf8");
  const own = [...page.matchAll(/<(script|style)>([^]*?)<\/\1>/g)]
    .map(([, , text]) => ` 'sha256-${createHash("sha256").update(text).digest("base64")}'`)
    .join("");
  return (
    `default-src 'none'; script-src 'self'${own}; style-src 'self'${own}; img-src 'self' data: blob:; connect-src 'self' ws: wss:; ` +
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'; require-trusted-types-for 'script'"
  );
}
const kTypes = { html: "text/html; charset=utf-8", js: "text/javascript; charset=utf-8", css: "text/css; charset=utf-8" };

// The page of the minutes, or a table, for the token of a seat that leads.
const kStyle = "body{font-family:sans-serif}";
async function minutes(room, request, answer) {
  let body = "";
  for await (const part of request) body += part;
  const form = new URLSearchParams(body);
  room.asked_minutes.push({ address: request.url, method: request.method, file: form.get("file") });
  const head = { "Content-Type": "text/plain; charset=utf-8", "Cache-Control": "no-store" };
  const seat = room.seats[room.tokens.get(form.get("token"))],
    isShared = room.room.shares_minutes && form.get("file") === "minutes.html";
  if (form.get("room") !== "BCDF" || (seat?.role !== "facilitator" && !(seat && isShared)))
    return answer.writeHead(403, head).end("Only who leads a room gets its minutes.\n");
  if (room.minutes_fault) return answer.writeHead(room.minutes_fault, head).end("The disk is full.\n");
  const policy = `default-src 'none'; style-src 'sha256-${createHash("sha256").update(kStyle).digest("base64")}'`;
  if (form.get("file") === "minutes.html")
    return answer
      .writeHead(200, { ...head, "Content-Type": "text/html; charset=utf-8", "Content-Security-Policy": policy })
      .end(`<!doctype html><html lang="en"><title>Minutes</title><style>${kStyle}</style><main><h1>The quarter</h1></main></html>`);
  return answer.writeHead(200, { ...head, "Content-Type": "text/csv; charset=utf-8" }).end("number,entry\n1,2\n");
}

// The formats of a plan, and a plan that cannot hold everything.
const kFormats = [
  {
    id: "dxf",
    label: "Drawing for CAD (DXF)",
    doc: "Plans at scale for drawing programs, with a layer for each use.",
    ending: ".dxf",
    options: [
      { id: "scale", doc: "So many metres are one metre on paper.", kind: "number", default: 200, minimum: 1, maximum: 10000 },
      { id: "paper", doc: "The sheet.", kind: "choice", default: "a3", choices: [{ id: "a3", doc: "420 by 297 mm." }, { id: "a1", doc: "841 by 594 mm." }] },
      { id: "with_dimensions", doc: "Whether lengths are written.", kind: "boolean", default: true },
    ],
  },
  { id: "pdf", label: "Plans at scale (PDF)", doc: "Sheets to print.", ending: ".pdf", options: [] },
];
async function plan_file(room, request, answer) {
  let body = "";
  for await (const part of request) body += part;
  const form = Object.fromEntries(new URLSearchParams(body));
  room.asked_plans.push({ ...form, token: room.seats[room.tokens.get(form.token)]?.role });
  answer.writeHead(200, { "Content-Type": "application/octet-stream", Notes: "Gard%C3%AAn%3A%20no%20shape%0ATerrain%3A%20left%20out" }).end("drawing");
}

/// Starts on a free port, or on the one that is named.
export async function serve(port = 0) {
  const room = new MockRoom(),
    bytes = { http: 0, state: 0 },
    own_policy = policy();
  const server = createServer((request, answer) => {
    const path = new URL(request.url, "http://x").pathname;
    if (path === "/minutes") return minutes(room, request, answer);
    if (path === "/export") return plan_file(room, request, answer);
    if (path === "/formats") return answer.writeHead(200, { "Content-Type": "application/json" }).end(JSON.stringify(kFormats));
    if (path.startsWith("/qr"))
      return answer
        .writeHead(200, { "Content-Type": "image/svg+xml" })
        .end('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4"><path fill="#fff" d="M0 0h4v4H0z"/><path d="M1 1h2v2H1z"/></svg>');
    const file = path.startsWith("/assets/") ? join(folder, path) : join(folder, "index.html");
    if (path.includes("..") || !existsSync(file) || path === "/favicon.ico") return answer.writeHead(404).end();
    answer.writeHead(200, {
      "Content-Type": kTypes[file.split(".").pop()],
      "Content-Encoding": "gzip",
      "Content-Security-Policy": own_policy,
      "Referrer-Policy": "no-referrer",
      "X-Content-Type-Options": "nosniff",
      "Cache-Control": path.startsWith("/assets/") ? "public, max-age=31536000, immutable" : "no-cache",
    });
    return createReadStream(`${file}.gz`)
      .on("data", (part) => (bytes.http += part.length))
      .pipe(answer);
  });
  const sockets = new WebSocketServer({
    server,
    path: "/ws",
    handleProtocols: (names) => (names.has("bl1") ? "bl1" : false),
    perMessageDeflate: false,
  });
  sockets.on("connection", (socket) => {
    const link = {
      send: (text) => {
        bytes.state += Buffer.byteLength(text);
        socket.send(text);
      },
      close: (code) => socket.close(code),
      drop: () => socket.terminate(),
    };
    room.connected(link);
    room.sockets = sockets;
    socket.on("message", (data) => room.receive(link, data.toString()));
    socket.on("close", () => room.closed(link));
  });
  await new Promise((ready) => server.listen(port, "127.0.0.1", ready));
  const stop = () => {
    for (const socket of sockets.clients) socket.terminate();
    server.close();
  };
  return { room, bytes, sockets, stop, port: server.address().port, address: `http://127.0.0.1:${server.address().port}` };
}

// By hand: node mock_server.mjs 8080, then open /BCDF, /BCDF#k=LEAD or /BCDF#k=SHOW&beamer.
if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { address, room } = await serve(Number(process.argv[2] ?? 8080));
  room.phase("Exploring", ["change", "comment", "vote", "draft"], { forms: ["smart_volume"], ends_at: Date.now() + 600000 });
  console.log(`${address}/BCDF   facilitator: ${address}/BCDF#k=LEAD   beamer: ${address}/BCDF#k=SHOW&beamer`);
}
