// Bots of tldraw sync: its own client, store and adapter, with records of one kind of ours.
import { FaultySocket } from "./faults.mjs";

const silent = { addEventListener: () => undefined, removeEventListener: () => undefined };
Object.assign(globalThis, {
  WebSocket: FaultySocket,
  document: { ...silent, hidden: false },
  requestAnimationFrame: (act) => setTimeout(act, 16),
});
globalThis.window = globalThis;
globalThis.navigator ??= {}; // node has one since 21
Object.assign(globalThis, silent);
globalThis.cancelAnimationFrame = clearTimeout;

const { Store, StoreSchema, createRecordType } = await import("@tldraw/store");
const { ClientWebSocketAdapter, TLSyncClient } = await import("@tldraw/sync-core");

export const Said = createRecordType("said", { scope: "document", validator: { validate: (value) => value } });
export const schema = StoreSchema.create({ said: Said });

export async function start_server() {
  const { start } = await import("./server_process.mjs");
  return start("tldraw_server.mjs");
}

export async function start_bot(server, number, seen) {
  const { atom } = await import("@tldraw/state");
  const store = new Store({ schema, props: {} });
  store.listen(
    ({ changes }) => {
      for (const record of Object.values(changes.added)) seen(record.id.slice(5));
    },
    { source: "remote", scope: "document" },
  );
  const socket = new ClientWebSocketAdapter(() => `ws://${server.host}/?sessionId=bot${number}`);
  const client = await new Promise((loaded, failed) => {
    const one = new TLSyncClient({
      store,
      socket,
      presence: atom("presence", null),
      onLoad: () => loaded(one),
      onSyncError: failed,
    });
  });
  return {
    say: (id) => store.put([Said.create({ id: Said.createId(id) })]),
    waiting: () => client.pendingPushRequests.length + Object.keys(client.speculativeChanges.added).length,
    close: () => {
      client.close();
      socket.close();
    },
  };
}
export const promise =
  "The server orders changes and keeps them in memory; a client makes its own changes again after it is back. There are no numbers of " +
  "operations: writing a record a second time is the same record.";
