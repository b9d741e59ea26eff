"""What a server bears: slow senders, floods, readers that read nothing, proxies, odd requests, a full disk."""
import asyncio
import base64
import json
import os
import resource
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import websockets

from room_client import Page, Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
SCENE = os.path.join(ROOT, "scenes/start/quarter.json")


class Case(unittest.TestCase):
    more = ()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.server = Server(PROGRAM, SCENE, folder.name, *self.more).start()
        self.addCleanup(lambda: self.server.process.poll() is None and self.server.kill())

    def page(self, role=None, **more):
        return Page(self.server, self.server.invites[role] if role else None, **more)

    def raw(self, data, seconds=60, source="127.0.0.1"):
        with socket.create_connection(("127.0.0.1", self.server.port), timeout=seconds, source_address=(source, 0)) as connection:
            connection.sendall(data)
            answer = b""
            try:
                while part := connection.recv(65536):
                    answer += part
            except (socket.timeout, ConnectionResetError):
                pass
            return answer


def upgrade(port, **more):
    fields = {"Host": f"127.0.0.1:{port}", "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
              "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), "Origin": f"http://127.0.0.1:{port}", **more}
    return ("GET /ws HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in fields.items()) + "\r\n").encode()


def frame(text, mask=b"\1\2\3\4"):
    data = text.encode()
    length = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + len(data).to_bytes(2, "big")
    return b"\x81" + length + mask + bytes(byte ^ mask[k % 4] for k, byte in enumerate(data))


class Slow(Case):
    def test_who_sends_slowly_is_sent_away_and_others_are_not_held_up(self):
        """A third of the sockets each: in the header, before the hello, within the hello. 127.0.0.x: each address has its own limit."""
        sockets = []
        hello = frame(json.dumps({"t": "hello", "room": self.server.code, "run": "slow"}))
        for k in range(int(os.environ.get("BL_SLOW", "60"))):
            one = socket.create_connection(("127.0.0.1", self.server.port), source_address=("127.0.0.%d" % (2 + k // 20), 0))
            one.sendall([b"GET / HT", upgrade(self.server.port), upgrade(self.server.port) + hello[:9]][k % 3])
            one.setblocking(False)
            sockets.append((one, time.monotonic()))

        async def others():
            lead = await self.page("facilitator").connect()
            latencies = []
            for k in range(40):
                began = time.monotonic()
                self.assertEqual((await lead.event("mark", text="number %d" % k))["t"], "ack")
                latencies.append(time.monotonic() - began)
                await asyncio.sleep(0.12)
            await lead.close()
            return latencies
        latencies = asyncio.run(asyncio.wait_for(others(), 200))
        longest, open_ones = 0, list(sockets)
        while open_ones and longest < 200:
            for one, began in list(open_ones):
                try:
                    while one.recv(65536):
                        pass
                    open_ones.remove((one, began))
                except BlockingIOError:
                    continue
                except OSError:
                    open_ones.remove((one, began))
            longest = time.monotonic() - sockets[0][1]
            time.sleep(0.02)
        for one, _ in sockets:
            one.close()
        print(f"slow: all closed within {longest:.1f} s; others' p95 {sorted(latencies)[-3] * 1000:.0f} ms", file=sys.stderr)
        self.assertFalse(open_ones)
        self.assertLess(sorted(latencies)[20], 3, "slow ones have six seconds, and nobody waits for them")

    def test_an_address_has_so_many_connections(self):
        first = [socket.create_connection(("127.0.0.1", self.server.port), source_address=("127.0.0.9", 0)) for _ in range(300)]
        left, gone, end = list(first), 0, time.monotonic() + 60
        for one in first:
            one.setblocking(False)
        while gone < 300 - 256 and time.monotonic() < end:
            for one in list(left):
                try:
                    is_gone = one.recv(1) == b""
                except BlockingIOError:
                    is_gone = False
                except OSError:
                    is_gone = True
                if is_gone:
                    left.remove(one)
                    gone += 1
            time.sleep(0.02)
        self.assertEqual(self.server.health()["rooms"][0]["code"], self.server.code, "another address gets in")
        for one in first:
            one.close()
        self.assertEqual(gone, 300 - 256)


class Reading(Case):
    def test_who_takes_nothing_is_sent_away_and_comes_back_to_all(self):
        """A window that does not read; another one says so much that it has to be left behind."""
        async def go():
            lead = await self.page("facilitator", kind="desktop", views=[]).connect()
            window = await self.page("designer", kind="desktop", views=["plan"]).connect()
            await lead.until(lambda: lead.scene)
            await window.until(lambda: window.scene)
            nodes = [node["id"] for node in lead.scene["scene"]["nodes"]]
            window.reader.cancel()  # the network takes what fits, and then nothing more
            began, sent, latencies = time.monotonic(), 0, []
            while self.server.health()["rooms"][0]["guests"] > 1:
                self.assertLess(time.monotonic() - began, 60)
                parts = [{"command": "rename_node", "arguments": {"id": nodes[k % len(nodes)], "name": "%d %s" % (sent, "n" * 1900)}} for k in range(100)]
                asked = time.monotonic()
                answer = await lead.command("batch", commands=parts)
                latencies.append(time.monotonic() - asked)
                self.assertEqual(answer["t"], "ack", answer)
                sent += 1
            last = answer["s"]
            await window.socket.close()
            await window.connect()
            await window.until(lambda: last in window.entries, 60)
            self.assertEqual(sorted(window.entries), list(range(1, max(window.entries) + 1)), "no gap")
            for page in (lead, window):
                await page.close()
            return sent, sorted(latencies)
        sent, latencies = asyncio.run(asyncio.wait_for(go(), 200))
        print(f"reading: sent away after {sent * 0.19:.0f} MB; the other's median {latencies[len(latencies) // 2] * 1000:.0f} ms", file=sys.stderr)


class Proxy(Case):
    more = ("--behind-proxy", "127.0.0.1")

    def status(self, source="127.0.0.1", **more):
        with socket.create_connection(("127.0.0.1", self.server.port), timeout=60, source_address=(source, 0)) as connection:
            connection.sendall(upgrade(self.server.port, **more))
            answer = b""
            while b"\r\n" not in answer:
                part = connection.recv(65536)
                self.assertTrue(part, answer)
                answer += part
            return int(answer.split(b" ")[1])

    def test_its_words_count_and_only_its(self):
        there = {"X-Forwarded-Host": "rooms.example.org", "X-Forwarded-Proto": "https", "X-Forwarded-For": "192.0.2.7"}
        self.assertEqual(self.status(**there, Origin="https://rooms.example.org"), 101)
        self.assertEqual(self.status(**there, Origin="http://rooms.example.org"), 403)
        self.assertEqual(self.status(**there), 403, "the page came from another host")
        self.assertEqual(self.status(source="127.0.0.5", **there, Origin="https://rooms.example.org"), 403, "this is not the proxy")
        self.assertEqual(self.status(source="127.0.0.5"), 101)
        request = f"GET /{self.server.code} HTTP/1.1\r\nHost: 10.0.0.1\r\nX-Forwarded-Host: rooms.example.org\r\nConnection: close\r\n\r\n"
        self.assertIn(b"wss://rooms.example.org", self.raw(request.encode()))
        self.assertIn(b"wss://10.0.0.1", self.raw(request.encode(), source="127.0.0.5"))


class Requests(Case):
    def test_what_means_two_things_is_refused(self):
        long = b"X: " + b"a" * 100000 + b"\r\n"
        for request in (b"GET / HTTP/1.1\r\nHost: x\r\n" + long + b"\r\n",
                        b"GET / HTTP/1.1\r\nHost: x\r\n" + b"X: y\r\n" * 20000 + b"\r\n",
                        b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\nHost: x\r\n\r\n",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\nContent-Length: 5\r\n\r\nabcde",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nContent-Length: 0x10\r\n\r\nabc",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nContent-Length: 18446744073709551617\r\n\r\nabc",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nContent-Length: 3, 5\r\n\r\nabcde",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nContent-Length : 3\r\n\r\nabc",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\nContent-Length: 3\r\n\r\n0\r\n\r\n",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: gzip, chunked\r\nContent-Length: 3\r\n\r\n0\r\n\r\n",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFFF\r\n\r\n",
                        b"POST /plain/X HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n-1\r\n\r\n",
                        b"GET / HTTP/1.1\r\nHost: x\r\nX: a\0b\r\n\r\n", b"GET /\0 HTTP/1.1\r\nHost: x\r\n\r\n",
                        b"GET / HTTP/1.1\nHost: x\n\n",
                        b"GET http://[::1/ HTTP/1.1\r\nHost: x\r\n\r\n", b"\0" * 10000 + b"\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"):
            answer = self.raw(request)
            self.assertTrue(answer == b"" or answer.split(b" ")[1][:1] == b"4", (request[:70], answer[:80]))
            self.assertEqual(answer.count(b"HTTP/1."), 1 if answer else 0, (request[:70], "one answer, for one request"))
        self.assertEqual(self.server.health()["rooms"][0]["code"], self.server.code)


class Disk(unittest.TestCase):
    def test_a_full_disk_is_told_and_the_room_goes_on_by_itself(self):
        """The server may write files of so many bytes only; later of any size."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        server = Server(PROGRAM, SCENE, folder.name).start()
        self.addCleanup(lambda: server.process.poll() is None and server.kill())

        async def go():
            lead = await Page(server, server.invites["facilitator"], views=["room", "comments"]).connect()
            watcher = await Page(server, views=["comments"]).connect()
            self.assertEqual((await lead.event("mark", text="before"))["t"], "ack")
            biggest = max(os.path.getsize(server.journal + end) for end in ("", "-wal") if os.path.exists(server.journal + end))
            unlimited = resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE)
            resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (biggest, unlimited[1]))
            for k in range(40):
                await lead.say({"t": "room", "e": {"event": "comment", "arguments": {"id": "full%d" % k, "text": "w" * 1500}}})
                await asyncio.sleep(0.02)
                if "storage" in watcher.says:
                    break
            await watcher.until(lambda: "storage" in watcher.says)
            shown = set(watcher.view.get("comments", {}))
            problem = server.health()["rooms"][0]["problem"]
            resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, unlimited)
            await watcher.until(lambda: "stored" in watcher.says)
            for number in sorted(lead.waiting):
                await lead.push(number)
            await lead.until(lambda: not lead.waiting)
            answers = [answer["t"] for answer in lead.answers.values()]
            self.assertEqual((await lead.event("mark", text="after"))["t"], "ack")
            await lead.close()
            await watcher.close()
            return problem, shown, answers
        problem, shown, answers = asyncio.run(asyncio.wait_for(go(), 100))
        print("disk: told as:", problem, file=sys.stderr)
        self.assertTrue(problem)
        self.assertEqual(server.stop(), 0)
        stored = subprocess.run([PROGRAM, "replay", server.journal], capture_output=True, text=True, timeout=100)
        self.assertEqual(stored.returncode, 0, stored.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
