# Checks volumes on the roofs of others from outside: `behaviourlinks run` on random scenes, and every plate again from its weights.
#
#   python3 podium_test.py BEHAVIOURLINKS [--sets N] [--seed S]
#
# All sides are straight and all plots convex, so that plates have to agree to 1e-9. A roof is the plate of the highest storey
# below it; a plate on it is what that roof, the bisectors with those on the same roof and the own form leave, moved in by the
# set-back.
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import plates as own

MOST, LEAST_AREA = 1e-9, 1.0  # relative deviation; m²: deviations of smaller plates are a share of this
STOREY = 3.2


def volume(rng, name, place, storeys, plate, base):
    footprint = {"form": rng.choice(["block", "block", "cell"]) if base else "block", "storeys": storeys,
                 "aspect": round(rng.uniform(0.5, 2), 3), "angle": round(rng.uniform(0, 180), 2)}
    if plate > 80 and rng.random() < 0.5:
        footprint["setback"] = rng.choice([0.5, 1, 1.5])
        footprint["full_storeys"] = rng.randint(0, storeys)
    if rng.random() < 0.3:
        footprint["party_walls"] = False
    if base:
        footprint["bases"] = [base]
    return {"id": name, "position": [round(place[0], 3), round(place[1], 3), 0],
            "types": {"footprint": footprint, "smart_volume": {"storey_height": STOREY, "demand": round(storeys * plate * STOREY, 3)}}}


def random_scene(rng):
    width, depth = rng.uniform(60, 120), rng.uniform(50, 90)
    ring = [[0, 0, 0], [width, 0, 0], [width, depth, 0], [0, depth, 0]]
    nodes = [{"id": "site", "types": {"boundary": {"form": "plan", "plan": ring, "height": 90}}},
             {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-7}}}]
    places = [(width * x, depth * y) for x in (0.25, 0.75) for y in (0.25, 0.75)]
    for k, place in enumerate(rng.sample(places, rng.randint(1, 4))):
        area = rng.uniform(0.3, 0.5) * width * depth / 4
        podium = volume(rng, f"a{k}", [c + rng.uniform(-4, 4) for c in place], rng.randint(1, 3), area, None)
        nodes.append(podium)
        count = rng.randint(1, 3)
        for t in range(count):
            at = [c + rng.uniform(-0.25, 0.25) * math.sqrt(area) for c in podium["position"][:2]]
            tower = volume(rng, f"b{k}-{t}", at, rng.randint(2, 6), 0.35 * area / count, podium["id"])
            nodes.append(tower)
            if rng.random() < 0.4:
                nodes.append(volume(rng, f"c{k}-{t}", at, rng.randint(1, 4), 0.05 * area / count, tower["id"]))
    rng.shuffle(nodes)
    nodes.sort(key=lambda node: node["id"])
    return {"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": nodes, "links": []}, [p[:2] for p in ring]


def moved_in(polygon, by):
    """All points of a convex polygon, counter-clockwise, that lie at least so far within it."""
    rest = polygon
    for (ax, ay), (bx, by_) in own.sides_of(polygon):
        length = math.hypot(bx - ax, by_ - ay)
        if length > 1e-9:
            n = ((by_ - ay) / length, (ax - bx) / length)
            rest = own.clipped(rest, n, n[0] * ax + n[1] * ay - by)
    return rest


def plate(node, weights, siblings, ground, setback):
    """The plate of a volume within a set-back, as a polygon."""
    footprint = node["types"]["footprint"]
    x, y, _ = node["position"]
    weight = weights[node["id"]]
    rest = moved_in(ground, setback) if setback else ground
    for other in siblings:
        dx, dy = other["position"][0] - x, other["position"][1] - y
        distance = math.hypot(dx, dy)
        if other is node:
            continue
        offset = (distance * distance + weight - weights[other["id"]]) / (2 * distance)
        if not footprint.get("party_walls", True):
            offset -= setback
        n = (dx / distance, dy / distance)
        rest = own.clipped(rest, n, offset + n[0] * x + n[1] * y)
    if footprint["form"] == "block":
        turn, aspect = math.radians(footprint["angle"]), footprint["aspect"]
        for quarter, half in enumerate([math.sqrt(weight * aspect), math.sqrt(weight / aspect)] * 2):
            n = (math.cos(turn + quarter * math.pi / 2), math.sin(turn + quarter * math.pi / 2))
            rest = own.clipped(rest, n, half - setback + n[0] * x + n[1] * y)
    return rest


class Tally:
    def __init__(self):
        self.scenes = self.plates = self.unmet = 0
        self.worst, self.failures = 0.0, []

    def check(self, number, scene, ring, run):
        self.scenes += 1
        fail = lambda text: self.failures.append(f"scene {number}: {text}")
        found = {volume["id"]: volume for volume in run["volumes"]}
        weights = {name: volume["weight"] for name, volume in found.items()}
        nodes = {node["id"]: node for node in scene["nodes"] if "footprint" in node["types"]}
        base_of = {name: node["types"]["footprint"].get("bases", [None])[0] for name, node in nodes.items()}
        roofs, tops = {None: ring}, {None: 0.0}
        for name in sorted(nodes):  # a podium before what stands on it
            node, base = nodes[name], base_of[name]
            siblings = [other for key, other in nodes.items() if base_of[key] == base]
            footprint = node["types"]["footprint"]
            setback = footprint.get("setback", 0)
            full = footprint.get("full_storeys", 0) if setback else footprint["storeys"]
            theirs = found[name]["plates"]
            if len(theirs) != footprint["storeys"]:
                fail(f"{name} has {len(theirs)} plates, but {footprint['storeys']} storeys are wished")
                return
            for storey, part in enumerate(theirs):
                polygon = plate(node, weights, siblings, roofs[base], 0 if storey < full else setback)
                ours = own.polygon_area(polygon)
                off = abs(part["area"] - ours) / max(ours, LEAST_AREA)
                self.worst = max(self.worst, off)
                self.plates += 1
                if not off <= MOST:
                    fail(f"{name}, storey {storey}: {part['area']!r} m², but {ours!r} m² ({off:.1e})")
                if abs(part["bottom"] - tops[base] - storey * STOREY) > 1e-9:
                    fail(f"{name}, storey {storey} begins at {part['bottom']} m")
            roofs[name], tops[name] = polygon, tops[base] + len(theirs) * STOREY
            wanted = node["types"]["smart_volume"]["demand"]
            if abs(found[name]["volume"] - wanted) > 2e-7 * wanted:
                self.unmet += 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--sets", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    tally = Tally()
    with tempfile.TemporaryDirectory() as folder:
        file, out = os.path.join(folder, "scene.json"), os.path.join(folder, "out.json")
        for number in range(options.sets):
            scene, ring = random_scene(random.Random(options.seed * 1000003 + number))
            with open(file, "w", encoding="utf-8") as written:
                json.dump(scene, written)
            done = subprocess.run([options.program, "run", file, "--json", out], capture_output=True, text=True)
            if done.returncode not in (0, 3):
                tally.failures.append(f"scene {number}: exit code {done.returncode}: {done.stderr}")
                continue
            with open(out, encoding="utf-8") as read:
                tally.check(number, scene, ring, json.load(read))
    print(f"{tally.scenes} scenes, {tally.plates} plates, largest deviation {tally.worst:.2e} (allowed {MOST:.0e}), "
          f"{tally.unmet} demands not met")
    for failure in tally.failures[:20]:
        print("FAILED: " + failure)
    sys.exit(1 if tally.failures or tally.plates == 0 else 0)


main()
