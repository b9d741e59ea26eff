"""`rehearse` fills a room with bots: what it prints is what the room has stored."""
import json
import os
import re
import sqlite3
import subprocess
import sys
import tempfile
import unittest

from room_client import Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]


def scene_with_cards(path):
    """The study of votes, with a role card for two groups."""
    with open(os.path.join(ROOT, "scenes/studies/vote_on_demands.json")) as file:
        scene = json.load(file)
    for name, node in (("owners", "homes-1"), ("traders", "work-1")):
        controls = [{"node": node, "port": "smart_volume.demand", "label": "Volume", "minimum": 500, "maximum": 3000, "step": 100}]
        scene["nodes"].append({"id": name, "types": {"stakeholder_group": {"interest": "Space", "controls": controls}}})
    with open(path, "w") as file:
        json.dump(scene, file)


class Rehearse(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        path = os.path.join(self.folder.name, "scene.json")
        scene_with_cards(path)
        self.server = Server(PROGRAM, path, self.folder.name).start()
        self.addCleanup(lambda: self.server.process.poll() is None and self.server.kill())

    def rehearse(self, key, *more):
        address = f"room://127.0.0.1:{self.server.port}/{self.server.code}" + (f"#k={key}" if key else "")
        done = subprocess.run([PROGRAM, "rehearse", address, *more], capture_output=True, text=True, timeout=120)
        self.assertIn("thrown away", done.stderr)
        rows = re.findall(r"^(\w+) +(\d+) +(\d+) +(\d+) +\S+ +\S+ *(.*)$", done.stdout, re.M)
        return done, {row[0]: tuple(int(number) for number in row[1:4]) + (row[4].strip(),) for row in rows}

    def expect_sound(self, done):
        """How fast the answers come is the machine's; that all come in and nothing is lost is not."""
        verdicts = {subject: verdict for verdict, subject in re.findall(r"^(good|look|bad) +(\w+) +\S", done.stdout, re.M)}
        self.assertEqual((verdicts["people"], verdicts["stored"]), ("good", "good"), done.stdout)
        self.assertEqual(done.returncode, 3 if "bad" in verdicts.values() else 0, done.stdout + done.stderr)

    def stored(self):
        self.assertEqual(self.server.stop(), 0)
        rows = sqlite3.connect(self.server.journal).execute("SELECT line FROM entry ORDER BY seq").fetchall()
        return [json.loads(row[0]) for row in rows]

    def test_with_the_facilitators_key_all_kinds_are_said_and_answered(self):
        done, kinds = self.rehearse(self.server.invites["facilitator"], "--bots", "8", "--seconds", "14")
        print(done.stdout, file=sys.stderr)
        self.expect_sound(done)
        self.assertIn("9 of 9 bots came in. Connections that were lost: 0.", done.stdout)
        lines = dict(re.findall(r"^(?:good|look|bad) +(\w+) +(\S.*)$", done.stdout, re.M))
        self.assertEqual(set(lines), {"people", "answers", "stored", "screens"}, done.stdout)
        told = kinds["comment"][0] + kinds["propose"][0]
        self.assertIn(f"0 lost of {told} stored comments and proposals, and 0 operations stored twice", lines["stored"])
        self.assertIn(f"{sum(kind[0] for kind in kinds.values())} operations: 0 without an answer", lines["answers"])
        self.assertRegex(lines["screens"], r"on all screens within \d")
        self.assertEqual(set(kinds), {"lead", "move", "vote", "comment", "draft", "propose", "rate"})
        for said, answered, refused, why in kinds.values():
            self.assertEqual(said, answered)
            self.assertLessEqual(refused, answered)
            self.assertEqual(refused == 0, why == "")
        self.assertEqual(kinds["vote"][:3], (16, 16, 0), "eight bots, two votes")
        self.assertEqual(kinds["lead"][2:], (0, ""))
        self.assertEqual(kinds["move"][2:], (0, ""), "inside the ranges of the card")
        # The room itself sets in the scene that a vote is open.
        entries = [json.dumps(entry) for entry in self.stored() if entry.get("author") != "room"]
        self.assertEqual(sum('"set_port"' in entry for entry in entries), kinds["move"][0])
        self.assertEqual(sum('"event": "comment"' in entry for entry in entries), kinds["comment"][0])

    def test_who_waits_is_told_how_far_it_is(self):
        done, kinds = self.rehearse("", "--bots", "2", "--seconds", "3", "--progress")
        lines = re.findall(r"^progress: (\d+) of 3 s, (\d+) operations, \d+ without an answer$", done.stdout, re.M)
        self.assertIn(len(lines), (2, 3, 4), done.stdout)
        said = [int(line[1]) for line in lines]
        self.assertEqual(said, sorted(said))
        self.assertLessEqual(said[-1], sum(kind[0] for kind in kinds.values()))

    def test_by_the_code_bots_are_participants(self):
        done, kinds = self.rehearse("", "--bots", "4", "--seconds", "4")
        self.expect_sound(done)
        self.assertIn("No bot had a role card", done.stdout)
        self.assertLessEqual(set(kinds), {"comment", "rate"})
        self.assertEqual(self.server.health()["rooms"][0]["seats"], 4)

    def test_who_does_not_come_in_is_said(self):
        for address, code in (("nowhere", 2), ("room://127.0.0.1:1/BKRT", 3), (f"room://127.0.0.1:{self.server.port}/XXXX", 3)):
            done = subprocess.run([PROGRAM, "rehearse", address, "--bots", "2", "--seconds", "1"], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn("there is no room with this code", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
