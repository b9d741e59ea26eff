// A room of Colyseus on a free port of the loopback: it counts how often each message has come.
import { createServer } from "node:http";
import { Room, Server } from "@colyseus/core";
import { Encoder, MapSchema, Schema, defineTypes } from "@colyseus/schema";
import { WebSocketTransport } from "@colyseus/ws-transport";

Encoder.BUFFER_SIZE = 1024 * 1024; // all that is said in a run

class Table extends Schema {
  constructor() {
    super();
    this.said = new MapSchema();
  }
}
defineTypes(Table, { said: { map: "number" } });

const counts = new Map();
class TableRoom extends Room {
  onCreate() {
    this.setState(new Table());
    this.maxClients = 200;
    this.autoDispose = false;
    this.onMessage("say", (_, id) => {
      counts.set(id, (counts.get(id) ?? 0) + 1);
      this.state.said.set(id, counts.get(id));
    });
  }
  onDrop(client) {
    this.allowReconnection(client, 30);
  }
}
console.info = console.log = () => undefined;
const http = createServer();
const server = new Server({ transport: new WebSocketTransport({ server: http }), greet: false });
server.define("table", TableRoom);
process.on("message", () => process.send({ stored: [...counts] }));
await server.listen(0, "127.0.0.1");
process.send({ host: `127.0.0.1:${http.address().port}` });
process.on("disconnect", () => process.exit(0));
