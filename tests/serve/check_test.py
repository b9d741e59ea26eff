"""`serve --check` measures, says what it found, opens nothing, and leaves nothing behind."""
import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import unittest

from room_client import Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
LINE = re.compile(r"(good|look|bad) +(\w+) +(\S.*)")
SUBJECTS = {"scene", "ticks", "disk", "space", "memory", "power", "clock", "numbers", "port", "network", "encryption", "invites",
            "page", "consent"}


class Check(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = self.place.name
        self.scene = os.path.join(ROOT, "scenes/studies/vote_on_demands.json")

    def check(self, *more, port=None, scene=None, bind="127.0.0.1", journal=None):
        command = [PROGRAM, "serve", scene or self.scene, "--check", "--bind", bind, "--port", str(port or self.free_port()),
                   "--journal", journal or os.path.join(self.folder, "room.blsession"), *more]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=self.folder)
        found = {}
        for line in done.stdout.splitlines():
            match = LINE.fullmatch(line)
            self.assertTrue(match, line)
            found.setdefault(match[2], []).append((match[1], match[3]))
        self.assertEqual(done.returncode, 3 if any(v == "bad" for all_ in found.values() for v, _ in all_) else 0 if found else 2,
                         done.stdout + done.stderr)
        return done, found

    def free_port(self):
        with socket.socket() as one:
            one.bind(("127.0.0.1", 0))
            return one.getsockname()[1]

    def test_each_line_has_a_verdict_and_nothing_is_left(self):
        done, found = self.check()
        print(done.stdout, file=sys.stderr)
        self.assertEqual(set(found), SUBJECTS)
        self.assertIn("2 votes", found["scene"][0][1].replace("\xa0", " "))
        self.assertIn("50 times", found["disk"][0][1])
        self.assertEqual(found["port"][0][0], "good")
        self.assertEqual(found["network"][0][0], "bad", "no phone opens an address of this computer alone")
        self.assertEqual(found["encryption"][0][0], "look")
        self.assertEqual(os.listdir(self.folder), [])

    def test_the_json_says_the_same(self):
        path = os.path.join(self.folder, "check.json")
        done, found = self.check("--json", path)
        with open(path) as file:
            rows = json.load(file)
        self.assertEqual([(row["verdict"], row["subject"], row["text"]) for row in rows],
                         [LINE.fullmatch(line).groups() for line in done.stdout.splitlines()])

    def test_a_port_that_something_else_has_is_bad(self):
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = other.getsockname()[1]
            other.settimeout(5)
            _, found = self.check(port=port)
        self.assertEqual(found["port"][0][0], "bad")
        self.assertIn(str(port), found["port"][0][1])

    def test_a_room_that_is_open_there_says_whether_anybody_has_reached_it(self):
        server = Server(PROGRAM, self.scene, self.folder).start()
        self.addCleanup(server.process.stdout.close)
        self.addCleanup(server.stop)
        _, found = self.check(port=server.port)
        self.assertEqual(found["port"][0][0], "look")
        self.assertIn(server.code, found["port"][0][1])
        health = server.health()
        self.assertEqual(health["reached"], {}, "this computer is no other device")
        self.assertGreater(health["machine"]["disk_free"], 0)
        self.assertGreater(health["machine"]["memory_free"], 0)
        self.assertIn("tick_ms", health["rooms"][0])

    def test_what_cannot_work_is_bad_and_says_so(self):
        _, found = self.check(journal=os.path.join(self.folder, "nowhere", "room.blsession"))
        self.assertEqual(found["disk"][0][0], "bad")
        self.assertIn("nowhere", found["disk"][0][1])
        _, found = self.check(journal="/proc/room.blsession")
        self.assertEqual(found["disk"][0][0], "bad", "nobody may write there, not even root")
        _, found = self.check(scene=os.path.join(self.folder, "missing.json"))
        self.assertEqual(found["scene"][0][0], "bad")
        broken = os.path.join(self.folder, "broken.json")
        with open(broken, "w") as file:
            file.write("{")
        _, found = self.check(scene=broken)
        self.assertEqual(found["scene"][0][0], "bad")
        _, found = self.check("--certificate", broken, "--key", broken)
        self.assertEqual(found["encryption"][0][0], "bad")
        self.assertEqual(found["port"][0][0], "good", "the port is not to blame")

    def certificate(self, name, days, host="DNS:session.example.org"):
        paper, key = (os.path.join(self.folder, name + end) for end in (".pem", ".key"))
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", paper, "-days", str(days),
                        "-subj", "/CN=room", "-addext", "subjectAltName=" + host], check=True, capture_output=True)
        return paper, key

    def test_a_certificate_is_judged_by_its_key_its_end_and_its_names(self):
        def encryption(paper, key, *more):
            _, found = self.check("--certificate", paper, "--key", key, *more)
            self.assertEqual(found["port"][0][0], "good")
            return found["encryption"][0]

        paper, key = self.certificate("long", 90)
        verdict, text = encryption(paper, key, "--name", "session.example.org")
        self.assertEqual(verdict, "look", "no authority has signed it: " + text)
        self.assertIn("no authority", text)
        self.assertNotIn("soon", text)
        self.assertIn("not made for that", encryption(paper, key)[1], "people come by the address of --bind")
        self.assertNotIn("not made", encryption(*self.certificate("here", 90, "IP:127.0.0.1"))[1])
        short, short_key = self.certificate("short", 3)
        verdict, text = encryption(short, short_key)
        self.assertEqual(verdict, "look")
        self.assertRegex(text, r"ends on \d{4}-\d{2}-\d{2} .*soon")
        verdict, text = encryption(paper, short_key)
        self.assertEqual(verdict, "bad")
        self.assertIn("another key", text)

    def test_a_role_card_that_names_nothing_is_told(self):
        with open(os.path.join(ROOT, "scenes/nodes/stakeholder_group.json")) as file:
            scene = json.load(file)
        path = os.path.join(self.folder, "cards.json")

        def lines(port):
            for node in scene["nodes"]:
                for control in node["types"].get("stakeholder_group", {}).get("controls", []):
                    control["port"] = port
            with open(path, "w") as file:
                json.dump(scene, file)
            return self.check(scene=path)[1]["scene"]

        self.assertEqual([verdict for verdict, _ in lines("indicator.target")], ["good"])
        good, told = lines("indicator.tarject")
        self.assertEqual((good[0], told[0]), ("good", "look"))
        self.assertIn("did you mean `target`?", told[1])
        self.assertIn("1 more", told[1])

    def test_wrong_calls_are_refused(self):
        for words in (["serve", "--check"], ["serve", self.scene, "--check", "--port", "70000"],
                      ["serve", self.scene, "--json", os.path.join(self.folder, "x.json")]):
            done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=60, cwd=self.folder)
            self.assertEqual(done.returncode, 2, words)

    def test_keys_that_others_can_read_are_told(self):
        path = os.path.join(self.folder, "keys.json")
        with open(path, "w") as file:
            file.write("{}")
        os.chmod(path, 0o644)
        _, found = self.check("--invites", path)
        self.assertEqual(found["invites"][0][0], "look")
        os.chmod(path, 0o600)
        _, found = self.check("--invites", path)
        self.assertEqual(found["invites"][0][0], "good")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
