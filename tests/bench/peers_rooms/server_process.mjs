// Starts the server of a peer in a process of its own, and asks it for what it holds.
import { fork } from "node:child_process";
import { fileURLToPath } from "node:url";

export async function start(file) {
  const child = fork(fileURLToPath(new URL(file, import.meta.url)), { stdio: ["ignore", "ignore", "inherit", "ipc"] });
  const told = () => new Promise((found) => child.once("message", found));
  const { host } = await told();
  return {
    host,
    pid: child.pid,
    async stored() {
      const answer = told();
      child.send("stored");
      const { stored } = await answer;
      child.kill();
      return new Map(stored);
    },
  };
}
