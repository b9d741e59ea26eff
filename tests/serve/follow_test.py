"""A second laptop takes a room over: the first is killed, and everybody comes back by their tokens."""
import asyncio
import json
import os
import re
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

from room_client import Page, Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
SCENE = os.path.join(ROOT, "scenes/start/quarter.json")


class Laptop:
    """`serve --follow`, and what it says."""

    def __init__(self, first, folder, *more, port=0):
        self.journal = os.path.join(folder, "copy.blsession")
        self.log = os.path.join(folder, "second.log")
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen(
                [PROGRAM, "serve", "--follow", f"room://127.0.0.1:{first.port}/{first.code}", "--token", first.invites["follow"],
                 "--journal", self.journal, "--port", str(port), "--bind", "127.0.0.1", *more], stdout=subprocess.PIPE, stderr=log, text=True)

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()

    def said(self):
        with open(self.log) as log:
            return log.read()

    def until(self, words, seconds=60):
        end = time.monotonic() + seconds
        while words not in self.said():
            assert time.monotonic() < end and self.process.poll() is None, f"not said: {words}\n{self.said()}"
            time.sleep(0.02)

    def serving(self):
        line = self.process.stdout.readline()
        match = re.fullmatch(r"room ([A-Z]+) at http://([^/:]+):(\d+)/([A-Z]+)\n", line)
        assert match, f"not serving: {line!r}\n{self.said()}"
        self.code, self.port = match[1], int(match[3])
        return self


class Follow(unittest.TestCase):
    def take_over(self, how, *more):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        first = Server(PROGRAM, SCENE, folder.name).start()
        self.addCleanup(first.process.stdout.close)
        self.addCleanup(lambda: first.process.poll() is None and first.kill())
        second = Laptop(first, folder.name, *more)
        self.addCleanup(second.end)
        second.until("follows room " + first.code)

        async def go():
            lead = await Page(first, first.invites["facilitator"]).connect()
            phones = [await Page(first, views=["room", "comments"], seed=k).connect() for k in range(12)]
            for k in range(5):
                for page in phones:
                    await page.say({"t": "room", "e": {"event": "comment", "arguments": {"id": "c%d-%d" % (page.you["seat"], k), "text": "words"}}})
            await asyncio.sleep(0.3)  # some are answered, some are on their way
            first.kill()
            killed = time.monotonic()
            for page in [lead, *phones]:
                await page.until(lambda: page.closed)
            if how == "signal":
                second.until("is away")
                second.process.send_signal(signal.SIGUSR1)
            await asyncio.get_running_loop().run_in_executor(None, second.serving)
            seats = {}
            for page in [lead, *phones]:
                seats[page.run] = page.you["seat"]
                page.server, page.closed = second, None
                await page.connect()
                self.assertEqual(page.you["seat"], seats[page.run])
            back = time.monotonic() - killed
            for page in phones:
                await page.until(lambda: not page.waiting)
            self.assertEqual((await lead.event("mark", text="We go on."))["t"], "ack")
            acknowledged = {(page.run, number) for page in [lead, *phones] for number, answer in page.answers.items() if answer["t"] == "ack"}
            for page in [lead, *phones]:
                await page.close()
            return back, acknowledged

        back, acknowledged = asyncio.run(asyncio.wait_for(go(), 200))
        print(f"{how}: everybody is back {back:.2f} s after the kill", file=sys.stderr)
        self.assertLess(back, 60)
        second.process.send_signal(signal.SIGINT)
        self.assertEqual(second.process.wait(timeout=60), 0)
        rows = sqlite3.connect(second.journal).execute("SELECT line FROM entry ORDER BY seq").fetchall()
        entries = [json.loads(row[0]) for row in rows]
        found = [(entry["origin"], entry["operation"]) for entry in entries if "operation" in entry]
        self.assertEqual(len(found), len(set(found)), "done twice")
        return acknowledged - set(found)

    def test_nothing_that_was_acknowledged_is_lost_where_answers_wait(self):
        self.assertEqual(self.take_over("signal", "--safe"), set())

    def test_it_takes_over_by_itself(self):
        self.take_over("time", "--take-over", "5")

    def test_pages_learn_where_the_room_would_go_on(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        first = Server(PROGRAM, SCENE, folder.name).start()
        self.addCleanup(first.process.stdout.close)
        self.addCleanup(lambda: first.process.poll() is None and first.kill())
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        own, other = f"http://127.0.0.1:{first.port}", f"http://127.0.0.1:{port}"

        async def go():
            early = await Page(first, views=[], seed=1).connect()
            self.assertEqual(early.welcome["addresses"], [own])
            second = Laptop(first, folder.name, port=port)
            self.addCleanup(second.end)
            await early.until(lambda: "addresses" in early.says)
            late = await Page(first, views=[], seed=2).connect()
            self.assertEqual(late.welcome["addresses"], [own, other])
            await asyncio.get_running_loop().run_in_executor(None, second.until, "follows room " + first.code)
            first.kill()
            await asyncio.get_running_loop().run_in_executor(None, second.until, "is away")
            second.process.send_signal(signal.SIGUSR1)
            await asyncio.get_running_loop().run_in_executor(None, second.serving)
            # The address that was told is the one at which the same key opens the same seat.
            self.assertEqual(f"http://127.0.0.1:{second.port}", other)
            seat, late.server = late.you["seat"], second
            await late.connect()
            self.assertEqual((late.you["seat"], late.welcome["addresses"]), (seat, [other]))
            await late.close()
            second.process.send_signal(signal.SIGINT)
            self.assertEqual(second.process.wait(timeout=60), 0)

        asyncio.run(asyncio.wait_for(go(), 200))

    def test_renewed_keys_send_the_second_laptop_away_and_it_does_not_take_over(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        first = Server(PROGRAM, SCENE, folder.name).start()
        self.addCleanup(first.process.stdout.close)
        self.addCleanup(lambda: first.process.poll() is None and first.kill())
        second = Laptop(first, folder.name, "--take-over", "5")
        self.addCleanup(second.end)
        second.until("follows room " + first.code)

        async def go():
            lead = await Page(first, first.invites["facilitator"]).connect()
            self.assertEqual((await lead.event("renew_keys"))["t"], "ack")
            await lead.close()

        asyncio.run(asyncio.wait_for(go(), 60))
        second.until("refuses this one")
        time.sleep(8)
        self.assertNotIn("takes the room over", second.said())
        self.assertNotIn("followers", first.health()["rooms"][0])
        second.process.send_signal(signal.SIGINT)
        self.assertEqual(second.process.wait(timeout=60), 0)
        with open(first.invites_file) as file:
            first.invites = json.load(file)[first.code]
        again = Laptop(first, folder.name)
        self.addCleanup(again.end)
        end = time.monotonic() + 60
        while "followers" not in first.health()["rooms"][0]:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)
        again.process.send_signal(signal.SIGINT)
        self.assertEqual(again.process.wait(timeout=60), 0)

    def test_it_says_what_it_lacks(self):
        for arguments, words in ((["--follow", "room://127.0.0.1:1/BKRT"], "--token"), (["--follow", "nowhere", "--token", "x", "--journal", "f"], "room://"), ([], "--follow")):
            told = subprocess.run([PROGRAM, "serve", *arguments], capture_output=True, text=True, timeout=60)
            self.assertEqual(told.returncode, 2, told)
            self.assertIn(words, told.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
