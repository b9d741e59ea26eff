"""A client of a room that shares no code with the program: connections, operations, and faults on purpose."""
import asyncio
import json
import os
import random
import re
import signal
import subprocess
import time
import urllib.request

import websockets


class Server:
    """The program `behaviourlinks serve` on a free port, with its session file in `folder`."""

    def __init__(self, program, scene, folder, *more, port=0):
        self.program, self.scene, self.folder, self.more = program, scene, folder, more
        self.journal = os.path.join(folder, "room.blsession")
        self.invites_file = os.path.join(folder, "invites.json")
        self.port = port
        self.process = None

    def start(self):
        source = self.journal if os.path.exists(self.journal) else self.scene
        command = [self.program, "serve", source, "--port", str(self.port), "--bind", "127.0.0.1",
                   "--journal", self.journal, "--invites", self.invites_file, *self.more]
        began = time.monotonic()
        with open(os.path.join(self.folder, "server.log"), "ab") as log:
            self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        line = self.process.stdout.readline()
        self.start_seconds = time.monotonic() - began
        match = re.fullmatch(r"room ([A-Z]+) at https?://([^/:]+):(\d+)/([A-Z]+)\n", line)
        assert match, f"not ready: {line!r}"
        self.code, self.port = match[1], int(match[3])
        with open(self.invites_file) as file:
            self.invites = json.load(file)[self.code]
        return self

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def stop(self):
        """Ctrl-C; the exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=60)

    def url(self, path):
        return f"http://127.0.0.1:{self.port}{path}"

    def get(self, path):
        with urllib.request.urlopen(self.url(path), timeout=60) as answer:
            return answer.status, dict(answer.headers), answer.read()

    def health(self):
        return json.loads(self.get("/health")[2])


class Page:
    """A page: one run, operations 1, 2, 3, …, each sent again until it is answered."""

    def __init__(self, server, invite=None, views=("room",), kind="page", seed=0, loss=0.0, doubled=0.0):
        self.server, self.invite, self.views, self.kind = server, invite, list(views), kind
        self.random = random.Random(seed)
        self.loss, self.doubled = loss, doubled
        self.run = "run%016x" % random.getrandbits(64)
        self.token, self.you, self.socket = None, None, None
        self.next, self.waiting, self.answers = 1, {}, {}
        self.sent_at, self.latencies = {}, []
        self.view, self.entries, self.scene, self.says, self.closed = {}, {}, None, [], None
        self.reader, self.missing, self.pushed_at, self.fault = None, None, {}, None
        self.changed = asyncio.Event()

    async def connect(self):
        origin = f"http://127.0.0.1:{self.server.port}" if self.kind == "page" else None
        self.socket = await websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws", origin=origin, subprotocols=["bl1"],
                                               max_size=None, open_timeout=60, ping_interval=None, compression=None)
        hello = {"t": "hello", "room": self.server.code, "run": self.run, "kind": self.kind, "views": self.views,
                 "unacked": max(self.answers, default=0) if not self.waiting else min(self.waiting) - 1,
                 "have": max(self.entries, default=0)}
        if self.token:
            hello["token"] = self.token
        elif self.invite:
            hello["invite"] = self.invite
        self.welcome = self.closed = None
        await self.socket.send(json.dumps(hello))
        self.reader = asyncio.ensure_future(self.read())
        await self.until(lambda: self.welcome or self.closed)
        if not self.welcome:
            raise ConnectionError(self.closed)
        for number in sorted(self.waiting):
            await self.push(number)
        return self

    async def read(self):
        try:
            async for text in self.socket:
                if self.loss and json.loads(text)["t"] != "welcome" and self.random.random() < self.loss:
                    continue
                self.hear(json.loads(text))
                self.changed.set()
        except (websockets.ConnectionClosed, OSError):
            pass
        except Exception as error:
            self.fault = error
            raise
        self.closed = (self.socket.close_code, self.socket.close_reason)
        self.changed.set()

    def hear(self, message):
        kind = message["t"]
        if kind == "welcome":
            self.welcome, self.you = message, message["you"]
            self.token = message.get("token") or self.token
            self.view = {}
        elif kind in ("ack", "nack"):
            number = message["id"]
            if kind == "nack" and message["why"] == "gap":
                self.missing = message["args"]["next"]
                return
            if kind == "nack" and message["why"] == "storage":
                return
            if number in self.answers:
                assert self.answers[number]["t"] == kind, (self.answers[number], message)
            else:
                self.answers[number] = message
                self.latencies.append(time.monotonic() - self.sent_at[number])
            self.waiting.pop(number, None)
        elif kind == "state":
            view = self.view.setdefault(message["view"], {})
            view.update(message["set"])
            for key in message.get("drop", []):
                view.pop(key, None)
        elif kind == "ops":
            for entry in message["e"]:
                self.entries[entry["s"]] = entry
        elif kind == "scene":
            self.scene = message
        elif kind == "say":
            self.says.append(message["id"])

    async def until(self, condition, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            self.changed.clear()
            try:
                await asyncio.wait_for(self.changed.wait(), max(0.01, min(0.25, end - time.monotonic())))
            except asyncio.TimeoutError:
                pass
            if self.fault:
                raise self.fault
            if time.monotonic() > end:
                raise TimeoutError(f"waited {seconds} s; closed: {self.closed}")

    def is_open(self):
        return self.socket is not None and self.socket.open

    async def push(self, number):
        self.pushed_at[number] = time.monotonic()
        if not self.is_open() or (self.loss and self.random.random() < self.loss):
            return
        try:
            for _ in range(2 if self.random.random() < self.doubled else 1):
                await self.socket.send(json.dumps(self.waiting[number]))
        except (websockets.ConnectionClosed, OSError):
            pass

    async def say(self, message):
        """Sends an operation; its number."""
        number, self.next = self.next, self.next + 1
        self.waiting[number] = {**message, "id": number}
        self.sent_at[number] = time.monotonic()
        await self.push(number)
        return number

    async def push_again(self):
        """What the server misses at once, and whatever has had no answer for half a second."""
        missing, self.missing = self.missing, None
        late = time.monotonic() - 0.5
        for number in sorted(self.waiting):
            if (missing is not None and number >= missing) or self.pushed_at[number] < late:
                await self.push(number)

    async def answer(self, message, seconds=60):
        number = await self.say(message)
        await self.until(lambda: number in self.answers, seconds)
        return self.answers[number]

    def command(self, command, **arguments):
        return self.answer({"t": "op", "c": {"command": command, "arguments": arguments}})

    def event(self, event, **arguments):
        return self.answer({"t": "room", "e": {"event": event, "arguments": arguments}})

    async def close(self):
        if self.socket is not None:
            await self.socket.close()
        if self.reader is not None:
            await self.reader
