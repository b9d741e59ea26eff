// Sockets of bots that lose messages before they reach the network, and connections that break on purpose.
import { WebSocket } from "ws";

/// The share of messages that is lost each way, once a connection has said hello.
export const faults = { loss: 0, random: () => 0.5, thrown: 0 };
export const sockets = new Set();

/// Numbers from 0 to 1 that are the same for the same seed.
export function random_of(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}

// So many messages each way open a connection in all three protocols, and are never lost.
const kGreeting = 3;

export class FaultySocket extends WebSocket {
  constructor(...all) {
    super(...all);
    this.said = 0;
    this.heard = 0;
    sockets.add(this);
    this.on("close", () => sockets.delete(this));
  }
  send(...all) {
    if (++this.said > kGreeting && faults.random() < faults.loss) return;
    super.send(...all);
  }
  emit(name, ...all) {
    if (name === "message" && ++this.heard > kGreeting && faults.random() < faults.loss) return true;
    // As in browsers, what a listener throws ends nothing.
    try {
      return super.emit(name, ...all);
    } catch (error) {
      faults.thrown++;
      return true;
    }
  }
}
