"""Nobody makes the server open a connection or a file who may not: a port and files are watched while people try."""
import asyncio
import ctypes
import json
import os
import socket
import sys
import tempfile
import time
import unittest

from room_client import Page, Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]


class WatchedPort:
    """A port of this computer, for TCP and UDP, that counts who comes."""

    def __init__(self):
        self.stream = socket.create_server(("127.0.0.1", 0), backlog=64)
        self.number = self.stream.getsockname()[1]
        self.packets = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.packets.bind(("127.0.0.1", self.number))
        self.stream.setblocking(False)
        self.packets.setblocking(False)
        self.seen = 0

    def count(self):
        for take in (lambda: self.stream.accept()[0].close(), lambda: self.packets.recv(4096)):
            try:
                while True:
                    take()
                    self.seen += 1
            except BlockingIOError:
                pass
        return self.seen

    def close(self):
        self.stream.close()
        self.packets.close()


class WatchedFile:
    """A file that counts how often it is opened, by inotify(7)."""

    IN_OPEN = 0x20

    def __init__(self, path, text):
        self.path = path
        with open(path, "w") as file:
            file.write(text)
        system = ctypes.CDLL(None, use_errno=True)
        self.handle = system.inotify_init1(os.O_NONBLOCK)
        assert self.handle >= 0, os.strerror(ctypes.get_errno())
        assert system.inotify_add_watch(self.handle, path.encode(), self.IN_OPEN) >= 0, os.strerror(ctypes.get_errno())
        self.seen = 0

    def count(self):
        try:
            while data := os.read(self.handle, 65536):
                self.seen += len(data) // 16  # one watched file has events without names, of 16 bytes each
        except BlockingIOError:
            pass
        return self.seen

    def close(self):
        os.close(self.handle)


def scene(path):
    """Each role has what it may change otherwise: an area, a role card that names the very ports, and a visitor's form."""
    outward = {"sensor": {}, "actuator": {}, "media": {}, "people_sensor": {}, "mqtt_broker": {}}
    controls = [{"node": "device", "port": f"{type_}.{port}", "minimum": 0, "maximum": 9} for type_, port in
                (("sensor", "address"), ("actuator", "address"), ("mqtt_broker", "host"), ("mqtt_broker", "port"))]
    nodes = [{"id": "device", "tags": ["north"], "types": outward},
             {"id": "volume", "tags": ["north"], "types": {"smart_volume": {}}},
             {"id": "card", "types": {"stakeholder_group": {"controls": controls}}}]
    with open(path, "w") as file:
        json.dump({"format": "behaviourlinks", "version": 1, "nodes": nodes, "links": []}, file)


class Reach(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.port = WatchedPort()
        self.file = WatchedFile(os.path.join(self.folder, "gauge.csv"), "time,level\n0,1.5\n1,2.5\n")
        self.addCleanup(self.port.close)
        self.addCleanup(self.file.close)
        self.path = os.path.join(self.folder, "scene.json")
        scene(self.path)

    def serve(self, *more):
        server = Server(PROGRAM, self.path, self.folder, *more).start()
        self.addCleanup(server.process.stdout.close)
        self.addCleanup(lambda: server.process.poll() is None and server.kill())
        return server

    def values(self):
        """By type and port: values that make a program with live connections reach out."""
        there = f"127.0.0.1:{self.port.number}"
        return [("sensor", "address", f"http://{there}/level"), ("sensor", "address", f"mqtt://{there}/level"),
                ("sensor", "address", f"replay:{self.file.path}#level"), ("sensor", "address", "replay:gauge.csv#level"),
                ("actuator", "address", f"mqtt://{there}/level"), ("actuator", "address", f"osc://{there}/level"),
                ("people_sensor", "address", f"mqtt://{there}/people"), ("media", "file", self.file.path),
                ("mqtt_broker", "host", "127.0.0.1"), ("mqtt_broker", "port", self.port.number),
                ("mqtt_broker", "ca_file", self.file.path), ("mqtt_broker", "password_from", f"file:{self.file.path}")]

    async def said(self, page, type_, port, value, number):
        """Every way to say it; how many, and which of them were not refused for want of the right."""
        set_port = {"command": "set_port", "arguments": {"node": "device", "port": f"{type_}.{port}", "value": value}}
        node = {"tags": ["north"], "types": {type_: {port: value}}}
        add = {"command": "add_node", "arguments": {"id": f"new_{number}", "node": node}}
        plain = {"command": "add_node", "arguments": {"id": f"plain_{number}", "node": {"tags": ["north"], "types": {"smart_volume": {}}}}}
        later = {"command": "typify", "arguments": {"node": f"plain_{number}", "typification": type_, "values": {port: value}}}
        batch = lambda *parts: {"command": "batch", "arguments": {"commands": list(parts)}}  # noqa: E731
        ways = [set_port, add, batch(set_port), batch(add), batch(plain, later)]
        taken, draft = [], f"draft_{page.you['seat']}_{number}"
        for way in ways:
            answer = await page.answer({"t": "op", "c": way})
            if answer.get("why") != "right":
                taken.append((way, answer))
        begun = await page.answer({"t": "draft", "do": "begin", "draft": draft})
        self.assertEqual(begun["t"], "ack", begun)
        await page.socket.send(json.dumps({"t": "want", "views": ["drafts"], "drafts": [draft]}))
        for way in ways:
            answer = await page.answer({"t": "op", "c": way, "draft": draft})
            if answer.get("why") != "right":
                taken.append(("in a draft", way, answer))
        return 2 * len(ways), taken

    async def everybody(self, server, roles):
        lead = await Page(server, server.invites["facilitator"], views=["room"]).connect()
        self.assertEqual((await lead.event("define_area", area="north", nodes={"tag": "north"}))["t"], "ack")
        types = sorted({type_ for type_, _, _ in self.values()})
        phase = await lead.event("set_phase", name="All", activities=["change", "draft", "comment", "vote"], forms=types)
        self.assertEqual(phase["t"], "ack", phase)
        pages = []
        for k, role in enumerate(roles):
            page = await Page(server, server.invites[role], views=[], kind="desktop", seed=k + 1).connect()
            seat = await lead.event("set_role", seat=page.you["seat"], role=role, areas=["north"], card="card")
            self.assertEqual(seat["t"], "ack", seat)
            pages.append(page)
        tried, number = 0, 0
        # They do have rights here: what is refused below is refused because it reaches out.
        fair = await pages[0].command("set_port", node="volume", port="smart_volume.demand", value=500)
        self.assertEqual(fair["t"], "ack", fair)
        for type_, port, value in self.values():
            for page, role in zip(pages, roles):
                number += 1
                count, taken = await self.said(page, type_, port, value, number)
                self.assertEqual(taken, [], f"{role}, {type_}.{port}")
                tried += count
        await asyncio.sleep(2)
        for page in [*pages, lead]:
            await page.close()
        return tried

    def expect_nothing(self, roles, *more):
        server = self.serve(*more)
        tried = asyncio.run(asyncio.wait_for(self.everybody(server, roles), 300))
        self.assertEqual(server.stop(), 0)
        self.assertGreaterEqual(tried, 100 * len(roles))
        self.assertEqual((self.port.count(), self.file.count()), (0, 0))
        print(f"{' '.join(more) or 'without --live'}: {tried} attempts, no connection and no file", file=sys.stderr)

    def test_people_reach_nothing_without_live_connections(self):
        self.expect_nothing(["designer", "stakeholder", "participant", "facilitator"])

    def test_people_reach_nothing_with_live_connections(self):
        self.expect_nothing(["designer", "stakeholder", "participant"], "--live")

    def test_what_watches_would_have_seen_it(self):
        """The same values from a facilitator in a room with live connections do reach out."""
        server = self.serve("--live")

        async def go():
            lead = await Page(server, server.invites["facilitator"], views=["room"]).connect()
            for value, watched in ((f"http://127.0.0.1:{self.port.number}/level", self.port), (f"mqtt://127.0.0.1:{self.port.number}/level", self.port),
                                   ("replay:gauge.csv#level", self.file)):
                before, end = watched.count(), time.monotonic() + 30
                answer = await lead.command("set_port", node="device", port="sensor.address", value=value)
                self.assertEqual(answer["t"], "ack", answer)
                while watched.count() == before:
                    self.assertLess(time.monotonic(), end, value)
                    await asyncio.sleep(0.05)
            await lead.close()

        asyncio.run(asyncio.wait_for(go(), 120))
        self.assertEqual(server.stop(), 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
