#!/usr/bin/env python3
"""Rooms over the network, from outside: joining, answers, views, pages without scripts, bad requests, kills, and replay.

usage: serve_test.py PROGRAM SOURCE_FOLDER [unittest arguments]"""
import asyncio
import base64
import hashlib
import json
import os
import re
import signal
import socket
import sqlite3
import ssl
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.parse
import urllib.request

import websockets

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from room_client import Page, Server  # noqa: E402

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
QUARTER = os.path.join(SOURCE, "scenes/start/quarter.json")
VOTE = os.path.join(SOURCE, "scenes/nodes/vote.json")


def wait(coroutine):
    return asyncio.run(coroutine)


class RoomCase(unittest.TestCase):
    scene = QUARTER
    more = ()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.server = Server(PROGRAM, self.scene, self.folder.name, *self.more).start()

    def tearDown(self):
        if self.server.process.poll() is None:
            self.assertEqual(self.server.stop(), 0, "Ctrl-C closes the room in order")
        self.server.process.stdout.close()
        self.folder.cleanup()

    def replay(self):
        done = subprocess.run([PROGRAM, "replay", self.server.journal], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def page(self, role=None, **more):
        return Page(self.server, self.server.invites[role] if role else None, **more)


class Joining(RoomCase):
    def test_by_code_and_by_invitation(self):
        async def go():
            lead = await self.page("facilitator", views=["room", "plan"]).connect()
            self.assertEqual(lead.you["role"], "facilitator")
            guest = await self.page(views=["room", "plan", "figures"]).connect()
            self.assertEqual(guest.you["role"], "participant")
            await guest.until(lambda: "plan" in guest.view and "room" in guest.view)
            self.assertEqual(len(guest.view["room"]["seats"]), 2)
            self.assertTrue([key for key in guest.view["plan"] if key.startswith("n/")])
            refused = await guest.command("rename_node", id=next(iter(guest.view["plan"]))[2:] or "x", name="Mine")
            self.assertEqual((refused["t"], refused["why"]), ("nack", "right"))
            self.assertEqual((await lead.event("set_phase", name="Look", activities=["comment"]))["t"], "ack")
            await guest.until(lambda: guest.view["room"]["phase"]["name"] == "Look")
            # The page is loaded again: the same seat, by its token.
            seat = guest.you["seat"]
            await guest.close()
            guest.run += "b"
            guest.next, guest.answers = 1, {}
            await guest.connect()
            self.assertEqual(guest.you["seat"], seat)
            await guest.close()
            await lead.close()
        wait(go())

    def test_nobody_gets_in_who_does_not_belong(self):
        async def go():
            for change, code in (({"invite": "0" * 16}, 4401), ({"token": "0" * 32}, 4401), ({"room": "ZZZZ"}, 4401)):
                hello = {"t": "hello", "room": self.server.code, "run": "r", **change}
                async with websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws", origin=self.server.url("")) as connection:
                    await connection.send(json.dumps(hello))
                    with self.assertRaises(websockets.ConnectionClosed):
                        await connection.recv()
                    self.assertEqual(connection.close_code, code, change)
            # Another site, another port, and a page that hides where it comes from.
            for origin in ("http://elsewhere.example", f"http://127.0.0.1:{self.server.port + 1}", "null"):
                with self.assertRaises(websockets.InvalidStatusCode) as refused:
                    await websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws", origin=origin)
                self.assertEqual(refused.exception.status_code, 403, origin)
            # A page without the address of its server is none.
            async with websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws") as connection:
                await connection.send(json.dumps({"t": "hello", "room": self.server.code, "run": "r"}))
                with self.assertRaises(websockets.ConnectionClosed):
                    await connection.recv()
            for frame, code in (("{", 4400), ('{"t": "op"}', 4408), ('{"t": "hello"}', 4400), ("[" * 500 + "]" * 500, 4400)):
                async with websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws", origin=self.server.url("")) as connection:
                    await connection.send(frame)
                    with self.assertRaises(websockets.ConnectionClosed):
                        await connection.recv()
                    self.assertEqual(connection.close_code, code, frame[:40])
        wait(go())
        self.assertEqual(self.server.health()["rooms"][0]["seats"], 0)

    async def why_refused(self, **who):
        """The code and the sentence with which a page is sent away."""
        async with websockets.connect(f"ws://127.0.0.1:{self.server.port}/ws", origin=self.server.url("")) as connection:
            await connection.send(json.dumps({"t": "hello", "room": self.server.code, "run": "stranger", **who}))
            with self.assertRaises(websockets.ConnectionClosed):
                await connection.recv()
            return connection.close_code, connection.close_reason

    def test_renewed_keys_void_old_invitations_and_no_token(self):
        old = dict(self.server.invites)

        def of_file():
            with open(self.server.invites_file) as file:
                return json.load(file)[self.server.code]

        async def go():
            lead = await self.page("facilitator", views=["keys"]).connect()
            ben = await self.page("designer", views=["keys"]).connect()
            await lead.until(lambda: lead.view.get("keys"))
            self.assertEqual((await ben.event("renew_keys"))["why"], "right")
            self.assertEqual((await lead.event("renew_keys"))["t"], "ack")
            await lead.until(lambda: lead.view["keys"]["designer"] != old["designer"])
            await ben.until(lambda: "keys" in ben.view)
            self.assertEqual(ben.view["keys"], {}, "only who leads sees keys")
            await lead.until(lambda: of_file() != old)
            new = of_file()
            self.assertEqual(lead.view["keys"], {role: key for role, key in new.items() if role != "follow"})
            self.assertFalse(set(new.values()) & set(old.values()))
            with open(os.path.join(self.folder.name, "server.log")) as log:
                said = log.read()
            self.assertIn("#k=" + new["facilitator"], said)
            self.assertIn("--token " + new["follow"], said)
            seat = ben.you["seat"]
            for again in range(2):
                # An old address, said once more.
                self.assertEqual(await self.why_refused(invite=old["designer"]),
                                 (4401, "the facilitator has renewed the keys: ask for a new invitation"))
                anna = await Page(self.server, new["stakeholder"], seed=10 + again).connect()
                self.assertEqual(anna.you["role"], "stakeholder")
                await anna.close()
                await ben.close()
                await ben.connect()
                self.assertEqual(ben.you["seat"], seat)
                if again == 0:
                    await lead.close()
                    self.assertEqual(self.server.stop(), 0)
                    self.server.process.stdout.close()
                    self.server.start()
                    self.assertEqual(self.server.invites, new)
            await ben.close()

        wait(go())
        self.assertEqual(self.server.stop(), 0)
        self.replay()

    def test_a_token_opens_its_own_room_only(self):
        journals = os.path.join(self.folder.name, "two")
        os.mkdir(journals)
        keys = os.path.join(journals, "keys.json")
        process = subprocess.Popen([PROGRAM, "serve", QUARTER, VOTE, "--port", "0", "--bind", "127.0.0.1", "--journal", journals, "--invites", keys],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            lines = [re.fullmatch(r"room ([A-Z]+) at http://[^:]+:([0-9]+)/.*", process.stdout.readline().strip()) for _ in range(2)]
            with open(keys) as file:
                invites = json.load(file)
            rooms = [type("Room", (), {"code": line[1], "port": int(line[2]), "invites": invites[line[1]]})() for line in lines]

            async def go():
                pages = [await Page(room, room.invites["facilitator"], seed=k).connect() for k, room in enumerate(rooms)]
                for page, other in zip(pages, reversed(rooms)):
                    for who in ({"token": page.token}, {"invite": page.server.invites["facilitator"]}):
                        async with websockets.connect(f"ws://127.0.0.1:{other.port}/ws", origin=f"http://127.0.0.1:{other.port}") as connection:
                            await connection.send(json.dumps({"t": "hello", "room": other.code, "run": "stranger", **who}))
                            with self.assertRaises(websockets.ConnectionClosed):
                                await connection.recv()
                            self.assertEqual(connection.close_code, 4401, who)
                    await page.close()

            wait(go())
        finally:
            process.terminate()
            process.wait(timeout=60)
            process.stdout.close()

    def test_a_newer_connection_of_the_same_page_replaces_the_older(self):
        async def go():
            one = await self.page("facilitator").connect()
            two = Page(self.server)
            two.run, two.token = one.run, one.token
            await two.connect()
            await one.until(lambda: one.closed)
            self.assertEqual(one.closed[0], 4409)
            await two.close()
        wait(go())


class Encrypted(unittest.TestCase):
    def test_a_page_that_came_unencrypted_gets_no_connection(self):
        """Whoever reads along could have put something into such a page."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        certificate, key = (os.path.join(folder.name, name) for name in ("certificate.pem", "key.pem"))
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", certificate, "-days", "1",
                        "-subj", "/CN=127.0.0.1", "-addext", "subjectAltName=IP:127.0.0.1"], check=True, capture_output=True, timeout=60)
        server = Server(PROGRAM, QUARTER, folder.name, "--certificate", certificate, "--key", key).start()
        self.addCleanup(server.process.stdout.close)
        self.addCleanup(lambda: server.process.poll() is None and server.kill())
        context = ssl.create_default_context(cafile=certificate)

        async def go():
            there = f"127.0.0.1:{server.port}"
            with self.assertRaises(websockets.InvalidStatusCode) as refused:
                await websockets.connect(f"wss://{there}/ws", origin=f"http://{there}", ssl=context)
            self.assertEqual(refused.exception.status_code, 403)
            async with websockets.connect(f"wss://{there}/ws", origin=f"https://{there}", ssl=context) as connection:
                await connection.send(json.dumps({"t": "hello", "room": server.code, "run": "r"}))
                welcome = json.loads(await connection.recv())
                self.assertEqual((welcome["t"], welcome["addresses"]), ("welcome", [f"https://{there}"]))

        wait(go())
        self.assertEqual(server.stop(), 0)


class Operations(RoomCase):
    def test_each_is_answered_once(self):
        async def go():
            lead = await self.page("facilitator", kind="desktop", views=[]).connect()
            await lead.until(lambda: lead.scene)
            node = lead.scene["scene"]["nodes"][0]["id"]
            done = await lead.command("rename_node", id=node, name="One")
            self.assertEqual(done["t"], "ack")
            await lead.until(lambda: done["s"] in lead.entries)
            self.assertEqual(lead.entries[done["s"]]["c"]["arguments"]["name"], "One")
            # The same again, in another form even: the same answer, and nothing happens.
            await lead.socket.send(json.dumps({"t": "op", "id": done["id"], "c": {"command": "rename_node", "arguments": {"id": node, "name": "Two"}}}))
            for what in (1, "x", [], None, {"event": 1}, {"event": "mark", "arguments": 1}, {}):
                odd = await lead.answer({"t": "room", "e": what})
                self.assertEqual((odd["t"], odd["why"]), ("nack", "bad"), what)
            for what in (1, "x", [], None, {"command": 1}, {"command": "rename_node", "arguments": 1}, {}):
                odd = await lead.answer({"t": "op", "c": what})
                self.assertEqual((odd["t"], odd["why"]), ("nack", "bad"), what)
            bad = await lead.answer({"t": "op", "c": {"command": "rename_node"}})
            self.assertEqual((bad["why"], bad["place"]), ("bad", "arguments"))
            odd = await lead.answer({"t": "op", "c": {"command": "rename_node"}, "colour": "red"})
            self.assertEqual((odd["why"], odd["place"]), ("bad", "colour"))
            undone = await lead.answer({"t": "undo"})
            self.assertEqual(undone["t"], "ack")
            self.assertEqual(lead.next - 1, len(lead.answers))
            await lead.close()
        wait(go())

    def test_a_flood_holds_up_nobody_else(self):
        async def go():
            lead = await self.page("facilitator").connect()
            flood = await self.page().connect()
            for number in range(1, 400):
                await flood.socket.send(json.dumps({"t": "room", "id": number, "e": {"event": "mark", "arguments": {"text": "x"}}}))
                flood.sent_at[number] = time.monotonic()
            for k in range(10):
                self.assertEqual((await lead.event("mark", text="decided %d" % k))["t"], "ack")
                if k == 0:
                    self.assertLess(len(flood.answers), 350, "who sends too fast waits, and nobody waits for them")
            await lead.close()
            await flood.close()
        wait(go())

    def test_kill_and_come_back(self):
        async def go():
            lead = await self.page("facilitator", kind="desktop", views=[]).connect()
            guests = [await self.page(views=["comments"], seed=k, doubled=0.1).connect() for k in range(4)]
            await lead.until(lambda: lead.scene)
            nodes = [node["id"] for node in lead.scene["scene"]["nodes"]]
            kills = int(os.environ.get("BL_KILLS", "6"))
            for k in range(kills):
                for page in [lead, *guests]:
                    if page is lead:
                        await page.say({"t": "op", "c": {"command": "rename_node", "arguments": {"id": nodes[k % len(nodes)], "name": "Name %d" % k}}})
                    await page.say({"t": "room", "e": {"event": "comment", "arguments": {"id": "c%d-%d" % (page.you["seat"], k), "text": "words %d" % k}}})
                await asyncio.sleep(0.002 * (k % 12))
                self.server.kill()
                for page in [lead, *guests]:
                    await page.until(lambda: page.closed)
                self.server.process.stdout.close()
                self.server.start()
                self.assertLess(self.server.start_seconds, 60)
                for page in [lead, *guests]:
                    page.closed = None
                    await page.connect()
            for page in [lead, *guests]:
                await page.until(lambda: not page.waiting)
                self.assertTrue(all(answer["t"] == "ack" for answer in page.answers.values()), page.answers)
            last = max(answer["s"] for answer in lead.answers.values())
            await lead.until(lambda: last in lead.entries)
            self.acknowledged = {(page.run, number): answer["s"] for page in [lead, *guests] for number, answer in page.answers.items()}
            for page in [lead, *guests]:
                await page.close()
        wait(go())
        self.assertEqual(self.server.stop(), 0)
        # In the file: every acknowledged operation, once, in order.
        rows = sqlite3.connect(self.server.journal).execute("SELECT seq, line FROM entry ORDER BY seq").fetchall()
        self.assertEqual([row[0] for row in rows], list(range(1, len(rows) + 1)))
        found = {}
        for seq, line in rows:
            entry = json.loads(line)
            if "operation" in entry:
                key = (entry["origin"], entry["operation"])
                self.assertNotIn(key, found, "done twice")
                found[key] = seq
        self.assertEqual(found, self.acknowledged)
        self.assertIn("agrees with all", self.replay())

    def test_a_second_server_on_the_file_is_told_who_holds_it(self):
        second = subprocess.run([PROGRAM, "serve", self.server.journal, "--port", "0", "--bind", "127.0.0.1"], capture_output=True, text=True, timeout=60)
        self.assertEqual(second.returncode, 2)
        self.assertIn(str(self.server.process.pid), second.stderr)

    def test_who_goes_on_with_a_file_is_told_that_the_scene_is_not_read(self):
        with open(os.path.join(self.folder.name, "server.log")) as log:
            self.assertNotIn("goes on", log.read(), "a new session")
        self.assertEqual(self.server.stop(), 0)
        again = subprocess.Popen([PROGRAM, "serve", QUARTER, "--port", "0", "--bind", "127.0.0.1", "--journal", self.server.journal],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertIn(self.server.code, again.stdout.readline())
        again.send_signal(signal.SIGINT)
        said = again.communicate(timeout=20)[1]
        self.assertIn(f"goes on with {self.server.journal}", said)
        self.assertIn(f"{QUARTER} now is not read", said)


class Votes(RoomCase):
    scene = VOTE

    def test_a_vote_moves_what_links_make_of_it(self):
        async def go():
            lead = await self.page("facilitator", views=["votes"]).connect()
            await lead.until(lambda: lead.view.get("votes"))
            name, vote = next(iter(lead.view["votes"].items()))
            opened = await lead.event("open_vote", vote=name)
            self.assertEqual(opened["t"], "ack", opened)
            pages = [await self.page(views=["votes"]).connect() for _ in range(5)]
            for page in pages:
                await page.until(lambda: page.view.get("votes", {}).get(name, {}).get("open"))
                ballot = {"yes_no": "yes", "slider": vote["most"]}.get(vote["kind"])
                if ballot is None:
                    first = vote["options"][0]["id"]
                    ballot = {"coins": {first: vote["points"]}, "rank": [option["id"] for option in vote["options"]],
                              "dots": [{"place": [0, 0, 0], "option": first}]}[vote["kind"]]
                answer = await page.command("cast_vote", node=name, voter="seat %d" % page.you["seat"], ballot=ballot)
                self.assertEqual(answer["t"], "ack", answer)
            stolen = await pages[0].command("cast_vote", node=name, voter="seat 1", ballot=ballot)
            self.assertEqual(stolen["why"], "right")
            self.assertEqual((await lead.event("close_vote", vote=name))["t"], "ack")
            await lead.until(lambda: lead.view["votes"][name]["count"] >= 5 and not lead.view["votes"][name]["open"])
            for page in [lead, *pages]:
                await page.close()
        wait(go())
        self.assertEqual(self.server.stop(), 0)
        self.replay()


class WithoutScripts(RoomCase):
    scene = VOTE

    def post(self, path, **fields):
        data = urllib.parse.urlencode(fields).encode()
        with urllib.request.urlopen(urllib.request.Request(self.server.url(path), data=data), timeout=60) as answer:
            self.assertNotIn("token", answer.url)
            return answer.read().decode()

    def test_a_mistyped_code_can_be_typed_again(self):
        for path in ("/ZZZZ", "/?code=zz+zz"):
            with self.assertRaises(urllib.error.HTTPError) as missing:
                self.server.get(path)
            self.assertEqual(missing.exception.code, 404)
            page = missing.exception.read().decode()
            self.assertIn("no room with the code “ZZZZ”", page)
            self.assertIn('name="code"', page)
        self.assertNotIn("no room", self.server.get("/")[2].decode())

    def test_join_and_comment(self):
        status, headers, door = self.server.get("/plain/" + self.server.code)
        self.assertEqual(status, 200)
        self.assertIn("Take part", door.decode())
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        inside = self.post(f"/plain/{self.server.code}/join")
        token = re.search(r'name="token" value="([0-9a-f]{32})"', inside)[1]
        said = self.post(f"/plain/{self.server.code}/comment", token=token, text="<b>More trees</b> & water\r\nplease")
        self.assertIn("Your comment is stored.", said)
        self.assertIn("&lt;b&gt;More trees&lt;/b&gt; &amp; water", said)
        self.assertNotIn("<b>More", said)
        self.assertIn("write something first", self.post(f"/plain/{self.server.code}/comment", token=token, text="  "))
        with self.assertRaises(urllib.error.HTTPError) as refused:
            self.post(f"/plain/{self.server.code}/comment", token="0" * 32, text="x")
        self.assertEqual(refused.exception.code, 403)

    def test_a_ballot_stands_in_the_answer_before_a_tick_has_read_it(self):
        token = re.search(r'name="token" value="([0-9a-f]{32})"', self.post(f"/plain/{self.server.code}/join"))[1]

        async def pause():
            lead = await self.page("facilitator", views=["room"]).connect()
            self.assertEqual((await lead.event("open_vote", vote="height"))["t"], "ack")
            self.assertEqual((await lead.event("set_pace", rate=10, is_paused=True))["t"], "ack")
            await lead.until(lambda: lead.view.get("room", {}).get("paused"))
            await lead.close()
        wait(pause())
        self.assertNotIn('value="17.5"', self.post(f"/plain/{self.server.code}", token=token))
        voted = self.post(f"/plain/{self.server.code}/vote", token=token, vote="height", value="17.5")
        self.assertIn("Your ballot is counted.", voted)
        self.assertIn('value="17.5"', voted)
        self.assertNotIn('value="99"', self.post(f"/plain/{self.server.code}/vote", token=token, vote="height", value="99"))

        async def close():
            lead = await self.page("facilitator", views=["votes"]).connect()
            self.assertEqual((await lead.event("set_pace", rate=10, is_paused=False))["t"], "ack")
            self.assertEqual((await lead.event("close_vote", vote="height"))["t"], "ack")
            await lead.until(lambda: lead.view.get("votes", {}).get("height", {}).get("mean") is not None)
            vote = lead.view["votes"]["height"]
            await lead.close()
            return vote
        vote = wait(close())
        after = self.post(f"/plain/{self.server.code}", token=token)
        section = next(part for part in after.split("<section>") if vote["question"] in part)
        ballots = "1\u00a0ballot is counted." if vote["count"] == 1 else f"{vote['count']}\u00a0ballots are counted."
        self.assertIn(ballots, section)
        for label, key in (("Mean", "mean"), ("Median", "median")):
            said = re.search(label + r"</td><td>([-0-9.]+) " + vote["unit"] + "</td>", section)
            self.assertAlmostEqual(float(said[1]), vote[key], delta=0.5)
        self.assertNotIn("Share", section, "a number has no share")


class BuiltPage(unittest.TestCase):
    def test_only_what_stands_in_the_built_page_may_run_in_it(self):
        def source(text):
            return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"
        with tempfile.TemporaryDirectory() as folder:
            script, style = "let a = 1 < 2;\n", "p { color: red }"
            with open(os.path.join(folder, "index.html"), "w") as file:
                file.write(f'<html><script>{script}</script><script src="/assets/x.js"></script><style>{style}</style></html>')
            server = Server(PROGRAM, QUARTER, folder, "--page", folder).start()
            try:
                policy = server.get("/" + server.code)[1]["Content-Security-Policy"]
                for directive in ("script-src", "style-src"):
                    sources = re.search(directive + " ([^;]*);", policy)[1].split()
                    self.assertEqual(sources, ["'self'", source(script), source(style)])
                self.assertNotIn("unsafe", policy)
                for path in ("/plain/" + server.code, "/health", "/"):
                    self.assertNotIn("sha256", server.get(path)[1]["Content-Security-Policy"], path)
            finally:
                self.assertEqual(server.stop(), 0)
                server.process.stdout.close()


class Pictures(RoomCase):
    def test_a_wifi_is_drawn_and_its_password_stands_in_no_address(self):
        def drawn(text):
            request = urllib.request.Request(self.server.url("/qr"), data=text, headers={"Content-Type": "text/plain"})
            with urllib.request.urlopen(request, timeout=60) as answer:
                self.assertEqual(answer.headers["Cache-Control"], "no-store")
                return answer.read()
        first = drawn(b"WIFI:T:WPA;S:Quarter;P:tulips;;")
        self.assertTrue(first.startswith(b"<svg"))
        self.assertEqual(first, drawn(b"WIFI:T:WPA;S:Quarter;P:tulips;;"))
        self.assertNotEqual(first, drawn(b"WIFI:T:WPA;S:Quarter;P:roses;;"))
        with self.assertRaises(urllib.error.HTTPError) as refused:
            drawn(b"x" * 4000)
        self.assertEqual(refused.exception.code, 414)


class Minutes(RoomCase):
    scene = VOTE

    def ask(self, token, file="minutes.html"):
        return self.post("/minutes", token=token, file=file)

    def post(self, path, **fields):
        data = urllib.parse.urlencode({"room": self.server.code, **fields}).encode()
        try:
            with urllib.request.urlopen(urllib.request.Request(self.server.url(path), data=data), timeout=60) as answer:
                return answer.status, answer.headers, answer.read().decode()
        except urllib.error.HTTPError as refused:
            return refused.code, refused.headers, refused.read().decode()

    def test_they_come_from_a_room_that_is_closed_to_who_leads_it(self):
        async def go():
            lead = await self.page("facilitator").connect()
            guest = await self.page("stakeholder", seed=1).connect()
            for vote, ballot in (("height", 23.5), ("money", {"bridge": 5})):
                self.assertEqual((await lead.event("open_vote", vote=vote))["t"], "ack")
                cast = await guest.command("cast_vote", node=vote, voter=f"seat {guest.you['seat']}", ballot=ballot)
                self.assertEqual(cast["t"], "ack", cast)
            self.assertEqual((await guest.event("comment", id="c1", text="<b>More trees</b>"))["t"], "ack")
            tokens = lead.token, guest.token
            while_open = self.ask(lead.token, "votes.csv")[2]
            for vote in ("height", "money"):
                self.assertEqual((await lead.event("close_vote", vote=vote))["t"], "ack")
            closed = await lead.event("close_room", shares_minutes=True)
            self.assertEqual(closed["t"], "ack", closed)
            await lead.close()
            await guest.close()
            return tokens, while_open
        (lead, guest), while_open = wait(go())
        self.assertIn("height,1,vote", while_open)
        self.assertNotIn("23.5", while_open, "a vote that is open shows no ballot before its close")
        self.assertNotIn("money,1,ballot", while_open, "nobody learns how somebody voted in secret")
        status, headers, page = self.ask(lead)
        self.assertEqual(status, 200, page)
        self.assertIn("&lt;b&gt;More trees&lt;/b&gt;", page)
        self.assertIn("style-src 'self' 'sha256-", headers["Content-Security-Policy"])
        self.assertNotIn("<script", page)
        self.assertEqual(headers["Cache-Control"], "no-store")
        status, headers, table = self.ask(lead, "comments.csv")
        self.assertEqual((status, headers["Content-Disposition"]), (200, 'attachment; filename="comments.csv"'))
        self.assertIn("<b>More trees</b>", table)
        votes = self.ask(lead, "votes.csv")[2]
        self.assertIn("23.5", votes)
        self.assertNotIn("money,1,ballot", votes)
        self.assertIn("Ballot of", page)
        status, _, shared = self.ask(guest)
        self.assertEqual(status, 200, shared)
        self.assertIn("&lt;b&gt;More trees&lt;/b&gt;", shared)
        self.assertNotIn("Ballot of", shared, "nobody learns at home how others voted")
        self.assertEqual(self.ask(guest, "votes.csv")[0], 403)
        plain = self.post(f"/plain/{self.server.code}", token=guest)[2]
        self.assertIn("Open the minutes", plain)
        self.assertEqual(self.ask("0" * 32)[0], 403)
        with self.assertRaises(urllib.error.HTTPError) as refused:
            self.server.get(f"/minutes?room={self.server.code}&file=minutes.html&token={lead}")
        self.assertEqual(refused.exception.code, 404, "an address opens nothing")
        # The plan can be saved in any format, by the same people and by designers.
        formats = json.loads(urllib.request.urlopen(self.server.url("/formats"), timeout=60).read())
        self.assertIn("ifc", [one["id"] for one in formats])
        status, _, why = self.post("/export", token=lead, format="dxf")
        self.assertEqual(status, 400)
        self.assertIn("the scene has no volumes", why)
        self.assertEqual(self.post("/export", token=guest, format="dxf")[0], 403)
        self.assertEqual(self.post("/export", token=lead, format="dwg")[0], 400)


class BadRequests(RoomCase):
    def raw(self, data, wait_for=60):
        with socket.create_connection(("127.0.0.1", self.server.port), timeout=wait_for) as connection:
            connection.sendall(data)
            answer = b""
            try:
                while part := connection.recv(65536):
                    answer += part
            except (socket.timeout, ConnectionResetError):
                pass
            return answer

    def test_no_file_outside_and_no_crash(self):
        for path in ("/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/assets/../index.html", "/assets/%2e%2e%2findex.html",
                     "/assets/..%5c..%5cx", "/assets/a%00.js", "/" + "A" * 3000, "/health/../health", "//etc/passwd", "/plain/../../x"):
            answer = self.raw(f"GET {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n".encode())
            self.assertRegex(answer.split(b"\r\n")[0], rb"HTTP/1.1 (4\d\d|303)", path)
            self.assertNotIn(b"root:", answer)
        for request in (b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 100000 + b"\r\n\r\n",
                        b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                        b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: -5\r\n\r\n", b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999\r\n\r\n",
                        b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", b"BREW / HTTP/1.1\r\nHost: x\r\n\r\n", b"\x00\x01\x02\r\n\r\n",
                        b"GET / HTTP/9.9\r\nHost: x\r\n\r\n", b"GET\r\n\r\n"):
            answer = self.raw(request)
            self.assertTrue(answer == b"" or re.match(rb"HTTP/1.[01] 4\d\d", answer), (request[:60], answer[:80]))
        self.assertEqual(self.server.health()["rooms"][0]["code"], self.server.code)

    def test_who_sends_slowly_is_sent_away(self):
        slow = [socket.create_connection(("127.0.0.1", self.server.port)) for _ in range(50)]
        for connection in slow:
            connection.sendall(b"GET / HT")
        for connection in slow:
            connection.settimeout(60)
            try:
                self.assertIn(connection.recv(10), (b"", b"HTTP/1.1 4"))
            except ConnectionResetError:
                pass  # who had to wait for its turn is not even read
            connection.close()


class Files(unittest.TestCase):
    def serve(self, *arguments):
        return subprocess.run([PROGRAM, "serve", "--port", "0", "--bind", "127.0.0.1", *arguments], capture_output=True, text=True, timeout=60)

    def test_bad_sources_have_reasons(self):
        with tempfile.TemporaryDirectory() as folder:
            journal = ["--journal", os.path.join(folder, "a.blsession")]
            missing = self.serve("nowhere.json", *journal)
            self.assertEqual(missing.returncode, 2)
            self.assertIn("nowhere.json", missing.stderr)
            broken = os.path.join(folder, "broken.json")
            with open(broken, "w") as file:
                file.write('{"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a", "types": {"plot": {"polygon": 4}}}]}')
            refused = self.serve(broken, *journal)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("polygon", refused.stderr)
            self.assertFalse(os.path.exists(journal[1]), "nothing is left behind")
            paper = self.serve(QUARTER, *journal, "--certificate", os.path.join(folder, "c.pem"), "--key", os.path.join(folder, "k.pem"))
            self.assertEqual(paper.returncode, 2)
            self.assertRegex(paper.stderr, r"c\.pem: .*No such file")
            away = subprocess.run([PROGRAM, "serve", QUARTER, "--port", "0", "--bind", "203.0.113.7", *journal], capture_output=True, text=True,
                                  timeout=30)
            self.assertIn("203.0.113.7 is no address of this computer", away.stderr)
            self.assertFalse(os.path.exists(journal[1]), "nothing is left behind")
            other = os.path.join(folder, "other.blsession")
            with open(other, "w") as file:
                file.write("a letter")
            self.assertEqual(self.serve(other).returncode, 2)
            with open(other) as file:
                self.assertEqual(file.read(), "a letter")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
