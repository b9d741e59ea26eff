"""A client of a room that shares no code with the program: connections, operations, and faults on purpose."""
import asyncio
import collections
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


class Pace:
    """How a careful client sends: below the limits of the server (core/serve), and not much at once, because of what comes behind a
    lost operation the server takes nothing. `window`: how many operations are under way that the server is not known to have decided.
    It halves when something was lost, and grows with each answer; what the network was like is known after an outage as well."""
    MOST = 16

    def __init__(self, burst, per_second, least):
        self.burst, self.per_second, self.least, self.window = burst, per_second, least, self.MOST
        self.begin()

    def begin(self):
        self.tokens, self.filled = self.burst, time.monotonic()

    def may_send(self):
        now = time.monotonic()
        self.tokens, self.filled = min(self.burst, self.tokens + (now - self.filled) * self.per_second), now
        if self.tokens < 1:
            return False
        self.tokens -= 1
        return True


class Page:
    """A page: one run, operations 1, 2, 3, …, each sent again until it is answered. Without a pace it sends all at once."""
    PATIENCE = 0.3  # an operation without an answer is sent again [s]

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
        self.pace, self.away, self.closes, self.merged = None, False, collections.Counter(), {}
        self.gap_before, self.gap_at, self.decided = None, 0, 0
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
        if self.pace:
            self.pace.begin()
            self.missing, self.gap_before = min(self.waiting, default=None), None
            await self.push_again()
            return self
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
                if self.pace and self.waiting:
                    await self.push_again()
        except (websockets.ConnectionClosed, OSError):
            pass
        except Exception as error:
            self.fault = error
            raise
        self.closed = (self.socket.close_code, self.socket.close_reason)
        self.closes[self.socket.close_code] += 1
        self.changed.set()

    def hear(self, message):
        kind = message["t"]
        if kind == "welcome":
            self.welcome, self.you = message, message["you"]
            self.decided = max(self.decided, message["done"])
            self.token = message.get("token") or self.token
            self.view = {}
        elif kind in ("ack", "nack"):
            number = message["id"]
            if kind == "nack" and message["why"] == "gap":
                self.decided = max(self.decided, message["args"]["next"] - 1)
                self.hear_gap(message["args"]["next"])
                return
            if kind == "nack" and message["why"] == "storage":
                return
            self.decided = max(self.decided, number)  # all before it are decided too, but not known how
            if number in self.answers:
                assert self.answers[number]["t"] == kind, (self.answers[number], message)
            else:
                self.answers[number] = message
                self.latencies.append(time.monotonic() - self.sent_at[number])
            if self.waiting.pop(number, None) and self.pace:
                self.pace.window = min(Pace.MOST, self.pace.window + 0.5)
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

    def hear_gap(self, missing):
        """All that came behind the missing one were refused as well: one of these answers is a reason to send again."""
        now = time.monotonic()
        if self.pace:
            if missing == self.gap_before and now - self.gap_at < self.PATIENCE:
                return
            self.pace.window = max(self.pace.least, self.pace.window // 2)
        self.missing, self.gap_before, self.gap_at = missing, missing, now

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
        text = json.dumps(self.waiting[number])
        try:
            for _ in range(2 if self.random.random() < self.doubled else 1):
                await self.socket.send(text)
        except (websockets.ConnectionClosed, OSError):
            pass

    async def say(self, message, replaces=None):
        """Sends an operation; its number. It takes the place of the last one that was said with the same `replaces`, where that
        has not been sent yet and nothing was said since: of a drag only the last value counts."""
        last = self.next - 1
        if replaces is not None and self.merged.get(last) == replaces and last in self.waiting and last not in self.pushed_at:
            self.waiting[last] = {**message, "id": last}
            return last
        number, self.next = self.next, self.next + 1
        self.waiting[number] = {**message, "id": number}
        self.sent_at[number] = time.monotonic()
        self.merged = {number: replaces}
        if self.pace:
            await self.push_again()
        else:
            await self.push(number)
        return number

    async def push_again(self):
        """What the server misses, and whatever has had no answer for a while; with a pace, only so many at once."""
        if not self.is_open():
            return
        missing, self.missing = self.missing, None
        late = time.monotonic() - self.PATIENCE
        if missing is not None:
            for number in self.pushed_at.keys() & self.waiting.keys():
                if number >= missing:
                    self.pushed_at[number] = 0
        under_way = 0
        for number in sorted(self.waiting):
            if self.pace and number > self.decided:
                under_way += 1
                if under_way > self.pace.window:
                    return
            if number in self.waiting and self.pushed_at.get(number, 0) < late:  # an answer may have come meanwhile
                if self.pace and not self.pace.may_send():
                    return
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
