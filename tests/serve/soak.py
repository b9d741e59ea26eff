#!/usr/bin/env python3
"""A session of many people with faults: what is lost, what is done twice, and how long answers and effects take.

usage: soak.py PROGRAM SOURCE_FOLDER [--seconds N] [--phones N] [--designers N] [--loss SHARE] [--outage SECONDS] [--kills N] [--pace SECONDS]
               [--scene FILE]

--pace: how often each phone says something, on average."""
import argparse
import asyncio
import json
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import Counter

import websockets

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from room_client import Pace, Page, Server  # noqa: E402


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def in_milliseconds(values):
    return "p50 %.0f ms, p95 %.0f ms, p99 %.0f ms" % tuple(1000 * quantile(values, share) for share in (0.5, 0.95, 0.99))


async def keep_connected(page, person=None, end=0):
    """Comes back after each broken connection, and says again what has no answer, until the person has said all."""
    while time.monotonic() < end or page.waiting or (person is not None and not person.done()):
        if page.away or page.is_open():
            await page.push_again()
            await asyncio.sleep(0.05)
            continue
        try:
            page.closed = None
            await page.connect()
        except (OSError, TimeoutError, websockets.WebSocketException):
            await asyncio.sleep(0.2 + 0.3 * page.random.random())


async def outages(page, end, seconds, returns):
    """Twice without a network for a while. Notes how many operations wait at each return, and how long until all of them are answered."""
    for _ in range(2):
        await asyncio.sleep(page.random.uniform(2, max(3, (end - time.monotonic()) / 3)))
        if time.monotonic() + seconds > end:
            return
        page.away = True
        for _ in range(int(seconds / 0.05)):
            if page.is_open():  # also a connection that was just being made
                page.socket.transport.abort()
            await asyncio.sleep(0.05)
        page.away = False
        queue, began = set(page.waiting), time.monotonic()
        while queue & page.waiting.keys():
            await asyncio.sleep(0.02)
        returns.append((len(queue), time.monotonic() - began))


async def phone(page, end, nodes, pace):
    number = 0
    while time.monotonic() < end:
        await asyncio.sleep(pace * page.random.uniform(0.4, 1.6))
        number += 1
        await page.say({"t": "room", "e": {"event": "comment", "arguments": {
            "id": "c%d-%d" % (page.you["seat"], number), "text": "Words %d" % number, "node": page.random.choice(nodes)}}})


async def designer(page, end, nodes):
    gesture = 0
    while time.monotonic() < end:
        gesture += 1
        node = page.random.choice(nodes)
        for _ in range(10):
            await page.say({"t": "op", "gesture": gesture, "c": {"command": "set_port", "arguments": {
                "node": node, "port": "smart_volume.demand", "value": page.random.randrange(500, 3000)}}},
                replaces=(gesture, node, "smart_volume.demand"))
            await asyncio.sleep(0.1)
        if page.random.random() < 0.3:
            await page.say({"t": "undo"})
        await asyncio.sleep(page.random.uniform(0.5, 2))


async def run(options, server, seed):
    lead = await Page(server, server.invites["facilitator"], kind="desktop", views=[], seed=seed).connect()
    await lead.until(lambda: lead.scene)
    nodes = [node["id"] for node in lead.scene["scene"]["nodes"] if "smart_volume" in node.get("types", {})]
    await lead.event("define_area", area="all", nodes={"typification": "smart_volume"})
    screen = await Page(server, server.invites["viewer"], views=["plan", "figures", "votes"], seed=seed).connect()
    pages, tasks, returns = [], [], []
    end = time.monotonic() + options.seconds
    for k in range(options.phones + options.designers):
        is_designer = k >= options.phones
        page = Page(server, server.invites["designer" if is_designer else "participant"], kind="desktop" if is_designer else "page",
                    views=[] if is_designer else ["room", "plan", "comments"], seed=seed + k + 1)
        await page.connect()
        if is_designer:
            await lead.event("set_role", seat=page.you["seat"], role="designer", areas=["all"])
        page.loss, page.doubled = options.loss, 0.05
        page.pace = Pace(150, 50, 4) if is_designer else Pace(28, 9, 2)
        pages.append(page)
        acts = designer(page, end, nodes) if is_designer else phone(page, end, nodes, options.pace)
        person = asyncio.ensure_future(acts)
        tasks.append(person)
        tasks.append(asyncio.ensure_future(keep_connected(page, person)))
        if options.outage:
            tasks.append(asyncio.ensure_future(outages(page, end, options.outage, returns)))
    heard = []

    async def probe():
        """How long an operation takes to reach another window, and its effect a screen."""
        number = 0
        while time.monotonic() < end:
            await asyncio.sleep(1)
            if not lead.is_open() or not screen.is_open():
                continue
            number += 1
            before, began = json.dumps(screen.view.get("plan", {}).get("n/" + nodes[0])), time.monotonic()
            answer = await lead.command("set_port", node=nodes[0], port="smart_volume.demand", value=800 + 600 * (number % 2))
            if answer["t"] != "ack":
                continue
            acked = time.monotonic() - began
            try:
                await screen.until(lambda: json.dumps(screen.view.get("plan", {}).get("n/" + nodes[0])) != before, 3)
                heard.append((acked, time.monotonic() - began))
            except TimeoutError:
                pass

    tasks.append(asyncio.ensure_future(probe()))
    if options.kills:
        tasks.append(asyncio.ensure_future(keep_connected(lead, end=end)))
        tasks.append(asyncio.ensure_future(keep_connected(screen, end=end)))

        async def kill():
            starts = []
            for _ in range(options.kills):
                await asyncio.sleep(options.seconds / (options.kills + 1) * random.uniform(0.5, 1.4))
                server.kill()
                server.process.stdout.close()
                await asyncio.get_running_loop().run_in_executor(None, server.start)
                starts.append(server.start_seconds)
            print("starts after kills: %d, median %.2f s, longest %.2f s" % (len(starts), quantile(starts, 0.5), max(starts)))
        tasks.append(asyncio.ensure_future(kill()))
    failed = [one for one in await asyncio.gather(*tasks, return_exceptions=True) if isinstance(one, Exception)]
    for one in failed:
        print("a client failed:", repr(one))
    for page in [lead, screen, *pages]:
        if not page.is_open():
            await page.connect()
    for page in pages:
        await page.until(lambda: not page.waiting, 60)
    last = max([answer["s"] for page in [lead, *pages] for answer in page.answers.values() if answer["t"] == "ack"])
    await lead.until(lambda: last in lead.entries, 30)
    for page in [lead, screen, *pages]:
        await page.close()
    return lead, pages, heard, failed, returns


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("source")
    for name, kind, usual in (("seconds", float, 60), ("phones", int, 50), ("designers", int, 5), ("loss", float, 0.3), ("outage", float, 0),
                              ("kills", int, 0), ("pace", float, 6), ("seed", int, 1)):
        parser.add_argument("--" + name, type=kind, default=usual)
    parser.add_argument("--scene", default="scenes/studies/sixty_volumes.json")
    parser.add_argument("--keep", help="where the session file is copied to")
    options = parser.parse_args()
    print("seed", options.seed)
    with tempfile.TemporaryDirectory() as folder:
        server = Server(options.program, os.path.join(options.source, options.scene), folder).start()
        began = time.monotonic()
        lead, pages, heard, failed, returns = asyncio.run(run(options, server, options.seed))
        seconds = time.monotonic() - began
        used = sum(map(int, open(f"/proc/{server.process.pid}/stat").read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")
        memory = next(int(line.split()[1]) for line in open(f"/proc/{server.process.pid}/status") if line.startswith("VmRSS")) / 1024
        health = server.health()
        code = server.stop()
        acknowledged = {(page.run, number): answer["s"] for page in [lead, *pages] for number, answer in page.answers.items() if answer["t"] == "ack"}
        refused = sum(answer["t"] == "nack" for page in [lead, *pages] for answer in page.answers.values())
        rows = sqlite3.connect(server.journal).execute("SELECT seq, line FROM entry ORDER BY seq").fetchall()
        found, doubled, gaps = {}, 0, [row[0] for row in rows] != list(range(1, len(rows) + 1))
        for seq, line in rows:
            entry = json.loads(line)
            key = (entry.get("origin"), entry.get("operation"))
            if key[1] is None:
                continue
            doubled += key in found and found[key][1] != (entry.get("gesture"), entry.get("event"))
            found[key] = (seq, (entry.get("gesture"), entry.get("event")))
        lost = [key for key in acknowledged if key not in found]
        replay = subprocess.run([options.program, "replay", server.journal], capture_output=True, text=True)
        acks = [one for page in pages for one in page.latencies]
        print("%d pages for %.0f s, %.0f %% lost each way: %d operations answered (%d refused), %d entries" %
              (len(pages), seconds, 100 * options.loss, len(acks), refused, len(rows)))
        print("acknowledged and lost: %d; done twice: %d; gaps: %s; exit code %d; failed clients: %s" % (len(lost), doubled, gaps, code, failed))
        if heard:
            print("calm links: answer %s; effect on the screen %s (%d probes)" % (
                in_milliseconds([one[0] for one in heard]), in_milliseconds([one[1] for one in heard]), len(heard)))
        if returns:
            times, queues = [one[1] for one in returns], [one[0] for one in returns]
            print("returns from outages: %d, with %.0f operations waiting in the middle, %d at most; all answered after p50 %.2f s, p95 %.2f s, "
                  "longest %.2f s; within 5 s: %d of %d" % (len(returns), quantile(queues, 0.5), max(queues), quantile(times, 0.5),
                                                           quantile(times, 0.95), max(times), sum(time <= 5 for time in times), len(times)))
        print("connections ended by:", ", ".join("%s %d times" % one for one in sorted(sum((page.closes for page in pages), Counter()).items())))
        print("server: %.0f %% of one core since its last start, %.0f MB, disk %.1f ms, file %.1f MB" %
              (100 * used / seconds, memory, health["disk_ms"], os.path.getsize(server.journal) / 1e6))
        if options.keep:
            shutil.copy(server.journal, options.keep)
        print("replay:", (replay.stdout + replay.stderr).strip().replace("\n", "; "))
        return 1 if lost or doubled or gaps or code or failed or replay.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
