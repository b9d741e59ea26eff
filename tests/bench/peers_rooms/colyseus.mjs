// Bots of Colyseus: its own SDK, with a room whose state is a map of what was said.
import { FaultySocket } from "./faults.mjs";

globalThis.WebSocket = FaultySocket;
const log = console.log;
console.info = () => undefined; // the SDK tells of each attempt to come back
const { Client, getStateCallbacks } = await import("@colyseus/sdk");

export async function start_server() {
  const { start } = await import("./server_process.mjs");
  return start("colyseus_server.mjs");
}

export async function start_bot(server, number, seen) {
  const client = new Client(`http://${server.host}`);
  const room = await client.joinOrCreate("table", {});
  let isGone = false;
  getStateCallbacks(room)(room.state).said.onAdd((_, id) => seen(id));
  room.onLeave(() => (isGone = true));
  room.onError(() => undefined);
  return {
    say: (id) => room.send("say", id),
    waiting: () => (isGone ? -1 : 0),
    close: () => {
      if (isGone) return;
      room.reconnection.enabled = false;
      room.leave().catch(() => log("not left"));
    },
  };
}
export const promise =
  "Messages go out once, in order, and have no answer. While a client is away it keeps its ten latest messages. It comes back by itself if " +
  "the connection had lived for five seconds, at most 15 tries. State is in memory and sent 20 times a second.";
