"""What takes minutes, and is run by hand: floods, joins, slow senders, memory, many rooms. Prints one line of figures for each."""
import asyncio
import json
import os
import random
import sqlite3
import ssl
import subprocess
import sys
import tempfile
import time

import websockets

from room_client import Page, Server

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
QUARTER = os.path.join(ROOT, "scenes/start/quarter.json")
VOTED = os.path.join(ROOT, "scenes/studies/vote_on_demands.json")
THOUSAND = os.path.join(ROOT, "scenes/studies/thousand_volumes.json")


def memory_of(process):
    with open(f"/proc/{process.pid}/smaps_rollup") as file:
        return sum(int(line.split()[1]) for line in file if line.startswith("Pss_Anon")) * 1024


def seconds_of(process):
    with open(f"/proc/{process.pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def mark95(values):
    return sorted(values)[int(len(values) * 0.95)] * 1000


async def idle(server, number, secure=False, seats=180):
    """One idle phone: connected, greeted, answering pings. Some share a seat, because a room has 200; addresses 127.0.1.x have 256 each."""
    context = None
    if secure:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    scheme = "s" if secure else ""
    connection = await websockets.connect(f"ws{scheme}://127.0.0.1:{server.port}/ws", origin=f"http{scheme}://127.0.0.1:{server.port}", ssl=context,
                                          subprotocols=["bl1"], compression=None, ping_interval=None, max_size=None,
                                          local_addr=("127.0.1.%d" % (1 + number // 200), 0))
    hello = {"t": "hello", "room": server.code, "run": "idle%d" % number, "views": ["room"]}
    if number >= seats:
        hello["token"] = idle.tokens[number % seats]
    await connection.send(json.dumps(hello))
    while (message := json.loads(await connection.recv()))["t"] != "welcome":
        pass
    if number < seats:
        idle.tokens[number] = message["token"]
    return connection


def certificate(folder):
    names = [os.path.join(folder, name) for name in ("key.pem", "certificate.pem")]
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", names[0], "-out", names[1],
                    "-subj", "/CN=room", "-days", "2"], check=True, capture_output=True)
    return ["--certificate", names[1], "--key", names[0]]


async def memory(folder, secure=False):
    server = Server(PROGRAM, QUARTER, folder, *(certificate(folder) if secure else []))
    server.start()
    idle.tokens = {}
    phones = [await idle(server, k, secure) for k in range(200)]
    await asyncio.sleep(5)
    before = memory_of(server.process)
    for k in range(200, 1200, 20):
        phones += await asyncio.gather(*(idle(server, j, secure) for j in range(k, k + 20)))
    tasks = [asyncio.ensure_future(drain(phone)) for phone in phones]
    await asyncio.sleep(10)
    each = (memory_of(server.process) - before) / 1000 / 1000
    print(f"memory {'TLS' if secure else 'plain'}: {each:.1f} kB for each of 1000 more idle phones")
    for task in tasks:
        task.cancel()
    server.kill()


async def drain(connection):
    async for _ in connection:
        pass


async def others(server, seconds, latencies):
    lead = await Page(server, server.invites["facilitator"]).connect()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        began = time.monotonic()
        await lead.event("mark", text="a decision")
        latencies.append(time.monotonic() - began)
        await asyncio.sleep(0.15)
    await lead.close()


async def flood(folder):
    """10 000 operations at once, and 10 000 refused ones with unknown ids at a thousand nodes."""
    server = Server(PROGRAM, THOUSAND, folder).start()
    calm, wild = [], []
    await others(server, 8, calm)
    before = memory_of(server.process)
    for name, content in (("operations", {"t": "room", "e": {"event": "mark", "arguments": {"text": "x"}}}),
                          ("refused operations", {"t": "op", "c": {"command": "rename_node", "arguments": {"id": "volume_unknown", "name": "x"}}})):
        role = "facilitator" if name != "operations" else None
        page = await Page(server, server.invites[role] if role else None, kind="page").connect()
        began = time.monotonic()

        async def pour():
            try:
                for number in range(1, 10001):
                    page.sent_at[number] = time.monotonic()
                    await page.socket.send(json.dumps({**content, "id": number}))
            except (websockets.ConnectionClosed, OSError):
                pass
        task = asyncio.ensure_future(pour())
        watch = asyncio.ensure_future(others(server, 40, wild))
        await page.until(lambda: page.closed, 60)
        after = time.monotonic() - began
        task.cancel()
        await watch
        print(f"flood of {name}: closed with {page.closed[0]} after {after:.1f} s, {len(page.answers)} of 10000 were answered; others' p95 "
              f"{mark95(wild):.0f} ms (calm {mark95(calm):.0f}); memory {(memory_of(server.process) - before) / 1e6:+.1f} MB")
        wild = []
    server.kill()


async def joins(folder):
    """A room has 200 seats: 150 in each of two rooms within three seconds; then 60 more in the first, of whom ten find no seat."""
    with open(QUARTER) as file:
        scene = json.load(file)
    paths = []
    for name in ("one.json", "two.json"):
        paths.append(os.path.join(folder, name))
        with open(paths[-1], "w") as file:
            json.dump(scene, file)
    process = subprocess.Popen([PROGRAM, "serve", *paths, "--port", "0", "--bind", "127.0.0.1", "--journal", folder], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
    lines = [process.stdout.readline().split() for _ in paths]
    server = type("Rooms", (), {"port": int(lines[0][3].split(":")[2].split("/")[0])})()
    errors, times = [], []

    async def join(k, code, delay):
        await asyncio.sleep(delay)
        began = time.monotonic()
        try:
            connection = await websockets.connect(f"ws://127.0.0.1:{server.port}/ws", origin=f"http://127.0.0.1:{server.port}", subprotocols=["bl1"],
                                                  compression=None, ping_interval=None, max_size=None, local_addr=("127.0.2.%d" % (1 + k // 200), 0))
            await connection.send(json.dumps({"t": "hello", "room": code, "run": "join%d" % k, "views": ["room", "plan", "card"]}))
            seen = set()
            while not {"welcome", "state"} <= seen:
                seen.add(json.loads(await connection.recv())["t"])
            times.append(time.monotonic() - began)
            return connection
        except Exception as error:
            errors.append(str(error))
    began = time.monotonic()
    held = await asyncio.gather(*(join(k, lines[k % 2][1], 3 * k / 300) for k in range(300)))
    print(f"joins: 300 in 3 s: {len(times)} seated, the last after {time.monotonic() - began:.1f} s; p95 of one {mark95(times):.0f} ms; errors {errors[:3]}")
    errors.clear()
    held += await asyncio.gather(*(join(300 + k, lines[0][1], 0) for k in range(60)))
    print(f"joins: 60 more in one room: {len(errors)} turned away: {errors[0] if errors else ''}")
    process.kill()


async def slow(folder):
    """500 slow sockets, a byte each five seconds, a third each in the header, before the hello and in the hello."""
    environment = dict(os.environ, BL_SLOW="500")
    test = os.path.join(os.path.dirname(os.path.abspath(__file__)), "limits_test.py")
    subprocess.run([sys.executable, test, PROGRAM, ROOT, "Slow.test_who_sends_slowly_is_sent_away_and_others_are_not_held_up"], env=environment)


async def rooms(folder):
    """Twenty quarters where somebody changes something each second; then three hundred where nobody does."""
    with open(QUARTER) as file:
        scene = file.read()

    def serve(count, where):
        os.makedirs(where)
        paths = []
        for k in range(count):
            paths.append(os.path.join(where, "room%d.json" % k))
            with open(paths[-1], "w") as file:
                file.write(scene)
        invites = os.path.join(where, "invites")
        process = subprocess.Popen([PROGRAM, "serve", *paths, "--port", "0", "--bind", "127.0.0.1", "--journal", where, "--invites", invites],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        lines = [process.stdout.readline().split() for _ in range(count)]
        with open(invites) as file:
            keys = json.load(file)
        return process, [type("Room", (), {"port": int(line[3].split(":")[2].split("/")[0]), "code": line[1], "invites": keys[line[1]]})() for line in lines]

    process, all_rooms = serve(20, os.path.join(folder, "active"))
    latencies = []

    async def use(room, seed):
        chance = random.Random(seed)
        page = await Page(room, room.invites["facilitator"], kind="desktop", views=["plan"]).connect()
        await page.until(lambda: page.scene, 60)
        volumes = [node["id"] for node in page.scene["scene"]["nodes"] if "smart_volume" in node.get("types", {})]
        await asyncio.sleep(chance.random())
        for _ in range(30):
            began = time.monotonic()
            await page.command("set_port", node=chance.choice(volumes), port="smart_volume.demand", value=chance.randint(500, 3000))
            latencies.append(time.monotonic() - began)
            await asyncio.sleep(max(0, 1 - (time.monotonic() - began)))
        await page.close()
    used, began = seconds_of(process), time.monotonic()
    await asyncio.gather(*(use(room, k) for k, room in enumerate(all_rooms)))
    share = (seconds_of(process) - used) / (time.monotonic() - began)
    print(f"rooms: 20 active: p95 of answers {mark95(latencies):.0f} ms, median {sorted(latencies)[len(latencies) // 2] * 1000:.0f} ms; {share:.2f} cores")
    process.kill()
    count = int(os.environ.get("BL_ROOMS", "300"))
    process, all_rooms = serve(count, os.path.join(folder, "idle"))
    for _ in range(60):  # until nothing is computed any more
        used = seconds_of(process)
        await asyncio.sleep(5)
        if (share := (seconds_of(process) - used) / 5) < 0.3:
            break
    used = seconds_of(process)
    await asyncio.sleep(20)
    print(f"rooms: {count} settled: {(seconds_of(process) - used) / 20:.3f} cores")
    process.kill()


def recounted(journal, vote, before):
    """The coins of each option by the ballots in the file, the last one of each voter; and the entries that are ballots of this vote."""
    rows = [json.loads(line) for (line,) in sqlite3.connect(journal).execute("SELECT line FROM entry ORDER BY seq")]
    ballots = [row for row in rows if row.get("command") == "cast_vote" and row["arguments"]["node"] == vote]
    last = {**before, **{row["arguments"]["voter"]: row["arguments"]["ballot"] for row in ballots}}
    coins = {}
    for ballot in last.values():
        for option, count in ballot.items() if isinstance(ballot, dict) else ():
            coins[option] = coins.get(option, 0) + count
    return coins, ballots, len(last)


async def vote(folder):
    """Fifty phones share out coins, and choose a height in secret; half of them sleep before the close. The shares move demands."""
    server = Server(PROGRAM, VOTED, folder).start()
    with open(VOTED) as file:
        node = next(node for node in json.load(file)["nodes"] if node["id"] == "people")["types"]["vote"]
    before = {row["voter"]: dict(zip(row["answer"].split(), row["coins"])) for row in node["ballots"]}
    lead = await Page(server, server.invites["facilitator"], kind="desktop", views=["votes", "plan"]).connect()
    await lead.until(lambda: "n/culture-1" in lead.view.get("plan", {}) and "people" in lead.view.get("votes", {}))
    figures = lambda name: json.dumps(lead.view["plan"]["n/" + name]["figures"])
    for name in ("people", "storeys"):
        answer = await lead.event("open_vote", vote=name)
        assert answer["t"] == "ack", answer
    phones = [await Page(server, server.invites["participant"], views=["room", "votes"], seed=k).connect() for k in range(50)]
    chance = random.Random(1)
    await asyncio.sleep(2)
    seen, began = figures("culture-1"), time.monotonic()
    for k, phone in enumerate(phones):
        await phone.until(lambda: phone.view.get("votes", {}).get("people", {}).get("open"))
        culture = chance.randint(6, 10)
        for name, ballot in (("people", {"culture": culture, "work": 10 - culture}), ("storeys", round(chance.uniform(2.6, 3.4), 1))):
            answer = await phone.command("cast_vote", node=name, voter=f"seat {phone.you['seat']}", ballot=ballot)
            assert answer["t"] == "ack", answer
        if k % 2:
            await phone.close()
    print(f"vote: 50 phones gave two ballots each in {time.monotonic() - began:.1f} s; 25 of them sleep")
    if figures("culture-1") != seen:
        print("vote: culture-1 moved while the vote was open")
    seen, began = figures("culture-1"), time.monotonic()
    for name in ("people", "storeys"):
        assert (await lead.event("close_vote", vote=name))["t"] == "ack"
    closed = time.monotonic() - began
    await lead.until(lambda: figures("culture-1") != seen, 20)
    print(f"vote: closed after {closed * 1000:.0f} ms; figures change {(time.monotonic() - began) * 1000:.0f} ms after the close was asked for (wanted 2000 ms)")
    last = time.monotonic()
    while time.monotonic() - last < 3:
        seen = figures("culture-1")
        await asyncio.sleep(0.1)
        if figures("culture-1") != seen:
            last = time.monotonic()
    print(f"vote: nothing moves any more {last - began:.1f} s after the close; culture-1: {figures('culture-1')}")
    shown = lead.view["votes"]["people"]
    await lead.close()
    for phone in phones:
        await phone.close()
    assert server.stop() == 0
    coins, ballots, count = recounted(server.journal, "people", before)
    told = {row["option"]: row["points"] for row in shown["result"]}
    print(f"vote: {len(ballots)} ballots in the file; recounted with those of the scene {coins} of {count} voters, shown {told} of {shown['count']}")
    _, secret, _ = recounted(server.journal, "storeys", {})
    voters = [row["arguments"]["voter"] for row in secret]
    threes = [voters[k:k + 3] for k in range(0, len(voters), 3)]
    print(f"vote: {len(secret)} secret ballots by {sorted({row['author'] for row in secret})}, without {sorted({'origin', 'operation', 'at'} - set().union(*secret))}; "
          f"each three in the order of their names: {all(three == sorted(three) for three in threes)}; voters like {voters[0]!r}")
    replay = subprocess.run([PROGRAM, "replay", server.journal], capture_output=True, text=True)
    print("vote: replay:", replay.stdout.strip().splitlines()[-1])


async def main():
    parts = {"memory": memory, "tls": lambda folder: memory(folder, True), "flood": flood, "joins": joins, "slow": slow, "rooms": rooms, "vote": vote}
    for part in sys.argv[3:] or parts:
        with tempfile.TemporaryDirectory() as folder:
            await parts[part](folder)


if __name__ == "__main__":
    with open("/proc/loadavg") as load:
        print("load of this machine:", " ".join(load.read().split()[:3]), "on", os.cpu_count(), "cores")
    asyncio.run(main())
