// A room of tldraw sync on a free port of the loopback.
import { createServer } from "node:http";
import { StoreSchema, createRecordType } from "@tldraw/store";
import { TLSocketRoom } from "@tldraw/sync-core";
import { WebSocketServer } from "ws";

const said = createRecordType("said", { scope: "document", validator: { validate: (value) => value } });
const quiet = { warn: () => undefined, error: () => undefined };
const room = new TLSocketRoom({
  schema: StoreSchema.create({ said }),
  log: quiet,
  initialSnapshot: { clock: 0, documents: [], schema: undefined },
});
const server = createServer();
new WebSocketServer({ server }).on("connection", (socket, request) =>
  room.handleSocketConnect({ sessionId: new URL(request.url, "http://x").searchParams.get("sessionId"), socket }),
);
process.on("message", () => {
  const ids = room.getCurrentSnapshot().documents.map((document) => document.state.id.slice(5));
  process.send({ stored: ids.map((id) => [id, 1]) });
});
server.listen(0, "127.0.0.1", () => process.send({ host: `127.0.0.1:${server.address().port}` }));
process.on("disconnect", () => process.exit(0));
