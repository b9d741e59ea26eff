# Checks `behaviourlinks fit` of standing volumes from outside: every plate of random sets again, from the weights that it wrote.
#
#   python3 standing_test.py BEHAVIOURLINKS [--sets N] [--seed S] [--batch N] [--save FOLDER]
#
# Sides that are straight on a convex plot have to agree to 1e-9, all others to 1e-6; see plates.py for how they are found.
import argparse
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

import plates as own

STRAIGHT, CURVED = 1e-9, 1e-6  # largest relative deviation of a plate
LEAST_AREA = 1.0  # m²: deviations of smaller plates are a share of this
TOLERANCE = 1e-6  # of a demand


def convex_plot(rng, size):
    angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(4, 8)))
    if max((b - a) % (2 * math.pi) for a, b in zip(angles, angles[1:] + angles[:1])) > 2.4:
        return [(0, 0), (size, 0), (size, size), (0, size)]
    return [(size / 2 + 0.6 * size * math.cos(a), size / 2 + 0.6 * size * math.sin(a)) for a in angles]


def plot(rng, size):
    """The rings of a plot, the first one around, and whether it is convex."""
    kind = rng.choice(["convex", "convex", "rectangle", "L", "U", "hole", "holes"])
    share = lambda low, high: size * rng.uniform(low, high)
    square = [(0, 0), (size, 0), (size, size), (0, size)]
    if kind == "convex":
        return [convex_plot(rng, size)], True
    if kind == "rectangle":
        high = share(0.3, 1)
        return [[(0, 0), (size, 0), (size, high), (0, high)]], True
    if kind == "L":
        x, y = share(0.3, 0.7), share(0.3, 0.7)
        return [[(0, 0), (size, 0), (size, y), (x, y), (x, size), (0, size)]], False
    if kind == "U":
        x, x2, y = share(0.25, 0.45), share(0.55, 0.75), share(0.2, 0.6)
        return [[(0, 0), (size, 0), (size, size), (x2, size), (x2, y), (x, y * 0.9), (x, size), (0, size)]], False
    holes = []
    for left in ([0.3] if kind == "hole" else [0.15, 0.6]):
        x, y, w, h = left * size, share(0.2, 0.5), share(0.1, 0.25), share(0.1, 0.3)
        holes.append([(x, y), (x, y + h), (x + w, y + h * 0.8), (x + w, y + 0.1 * h)])
    return [square] + holes, False


def placed(rings, rng):
    """The rings turned and moved, to the millimetre."""
    turn, far = rng.choice([0, rng.uniform(0, 6.28)]), rng.choice([0, 1000])
    dx, dy = rng.uniform(-far, far), rng.uniform(-far, far)
    c, s = math.cos(turn), math.sin(turn)
    return [[(round(c * x - s * y + dx, 3), round(s * x + c * y + dy, 3)) for x, y in ring] for ring in rings]


def inside(rings, x, y):
    odd = False
    for ring in rings:
        for (ax, ay), (bx, by) in own.sides_of(ring):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                odd = not odd
    return odd


def random_sides(rng, rings):
    """What holds at each kind of side; streets run beside some sides of the plot, not quite in their direction."""
    sides = {"party_walls": rng.random() < 0.5, "border_walls": rng.random() < 0.5,
             "border": rng.choice([0, 0, 1, 2.5]), "street": rng.choice([0, 0, 1.5, 4]), "courtyards": rng.choice([[], [0, 1], [2]])}
    if rng.random() < 0.5:
        sides["wing_depth"] = rng.choice([3, 6, 50])
    if rng.random() < 0.7:
        beside = rng.sample(own.sides_of(rings[0]), rng.randint(1, 3))
        sides["streets"] = [{"points": [[ax, ay], [bx + rng.uniform(-5, 5), by + rng.uniform(-5, 5)]], "reach": 6}
                            for (ax, ay), (bx, by) in beside]
    return sides


def random_case(rng):
    size = rng.uniform(50, 160)
    rings, is_convex = plot(rng, size)
    rings = placed(rings, rng)
    xs, ys = [p[0] for p in rings[0]], [p[1] for p in rings[0]]
    count, sites = rng.choice([1, 2, 3, 5, 8, 12, 16]), []
    while len(sites) < count:
        x, y = round(rng.uniform(min(xs), max(xs)), 3), round(rng.uniform(min(ys), max(ys)), 3)
        if inside(rings, x, y) and all((x, y) != (s[0], s[1]) for s in sites):
            sites.append((x, y, 0))
    form = {"kind": rng.choice(["round", "block", "cell"]), "storeys": [rng.randint(1, 7) for _ in sites],
            "storey_height": rng.choice([2.8, 3, 3.5]), "setbacks": [], "angle": rng.uniform(-180, 180),
            "aspect": rng.choice([1, rng.uniform(0.4, 2.5)]), "depth": rng.choice([None, None, 5, 7.5, 200])}
    if rng.random() < 0.7:
        form["setbacks"] = [rng.choice([0, 0, 1, 1.5, 2.5]) for _ in range(rng.randint(1, 4))]
    if rng.random() < 0.5:
        form["sides"] = random_sides(rng, rings)
    case = {"boundary": {"plan": rings[0], "holes": rings[1:], "bottom": 0, "top": 60}, "sites": sites, "form": form,
            "convex": is_convex}
    add_demands(case, rng)
    return case


def add_demands(case, rng):
    form, count = case["form"], len(case["sites"])
    area = sum(abs(own.polygon_area(ring)) * (1 if k == 0 else -1)
               for k, ring in enumerate([case["boundary"]["plan"]] + case["boundary"]["holes"]))
    cover = rng.choice([0.1, 0.25, 0.4, 0.5, 0.6])
    shares = [rng.uniform(1, 6) for _ in range(count)]
    floors = [share / sum(shares) * cover * area * n for share, n in zip(shares, form["storeys"])]
    if form["setbacks"] or form["depth"] or "sides" in form:
        floors = [0.7 * floor for floor in floors]
    if form["kind"] == "cell":
        # Cells share all of the plot, so that few demands can be met: those that some weights give.
        weights = [rng.uniform(0, 0.2) * area / count for _ in range(count)]
        floors = [sum(own.plates(case, i, weights)[0]) for i in range(count)]
    groups = [[i] for i in range(count)]
    if count >= 5 and rng.random() < 0.2:
        groups = [[0, 1]] + [[i] for i in range(2, count)]
        case["groups"] = groups
    if count >= 3 and "groups" not in case and form["kind"] != "cell" and rng.random() < 0.2:
        case["locked"] = [count - 1]
        case["weights"] = [0] * (count - 1) + [round(floors[-1] / form["storeys"][-1] / math.pi, 2)]
    demands, case["bounds"] = [], []
    for group in groups:
        floor = sum(floors[i] for i in group)
        if group == case.get("locked"):
            demands.append(None)
            continue
        least, most = (floor, floor) if rng.random() < 0.8 else (floor * 0.8, floor * 1.2)
        is_volume = rng.random() < 0.3
        unit = form["storey_height"] if is_volume else 1
        amount = least * unit if least == most else {"min": least * unit, "max": most * unit}
        demands.append(amount if is_volume else {"floor_area": amount})
        case["bounds"].append((group, least, most))
    case["demands"] = demands


class Tally:
    def __init__(self):
        self.sets = self.sites = self.plates = self.not_met = 0
        self.worst = {True: 0.0, False: 0.0}
        self.steps, self.reasons, self.failures = [], {}, []

    def check(self, number, case, result):
        self.sets += 1
        self.steps.append(result["iterations"])
        fail = lambda text: self.failures.append(f"set {number}: {text}")
        weights = result["weights"]
        if [s["weight"] for s in result["sites"]] != weights:
            fail("`weights` and `sites` differ")
        floors = []
        for i, site in enumerate(result["sites"]):
            areas, is_straight = own.plates(case, i, weights)
            self.sites += 1
            self.plates += len(areas)
            if len(site["plates"]) != len(areas):
                fail(f"site {i} has {len(site['plates'])} plates, but {len(areas)} storeys")
                continue
            floors.append(sum(areas))
            if abs(sum(site["plates"]) - site["floor_area"]) > 1e-12 * site["floor_area"]:
                fail(f"the plates of site {i} do not add up to its floor area")
            for k, (theirs, ours) in enumerate(zip(site["plates"], areas)):
                off = abs(theirs - ours) / max(ours, LEAST_AREA)
                self.worst[is_straight] = max(self.worst[is_straight], off)
                if not off <= (STRAIGHT if is_straight else CURVED):
                    fail(f"site {i}, storey {k}: {theirs!r} m², but {ours!r} m² ({off:.1e}; {case['form']['kind']})")
        if len(floors) == len(weights):
            self.check_demands(fail, case, result, floors)

    def check_demands(self, fail, case, result, floors):
        if result["status"] != "met":
            self.not_met += 1
            first = result["status"] + ": " + (result["reasons"] or ["no reason"])[0]
            first = "".join("#" if c.isdigit() else c for c in first)
            while "##" in first:
                first = first.replace("##", "#")
            self.reasons[first] = self.reasons.get(first, 0) + 1
            return
        for group, least, most in case["bounds"]:
            has = sum(floors[i] for i in group)
            wanted = min(max(has, least), most)
            if abs(has - wanted) > 2 * TOLERANCE * wanted:
                fail(f"status `met`, but sites {group} have {has} m² instead of {wanted} m²")
        for i in case.get("locked", []):
            if result["weights"][i] != case["weights"][i]:
                fail(f"site {i} is locked, but has another weight")

    def print(self):
        print(f"{self.sets} sets, {self.sites} sites, {self.plates} plates")
        print(f"largest deviation, straight sides on convex plots: {self.worst[True]:.2e} (allowed {STRAIGHT:.0e})")
        print(f"largest deviation, arcs, holes and inner corners:   {self.worst[False]:.2e} (allowed {CURVED:.0e})")
        print(f"Newton steps: median {statistics.median(self.steps):g}, most {max(self.steps)}")
        print(f"not met: {self.not_met}")
        for reason, count in sorted(self.reasons.items(), key=lambda r: -r[1])[:12]:
            print(f"  {count:5d}  {reason}")
        for failure in self.failures[:20]:
            print("FAILED: " + failure)
        if len(self.failures) > 20:
            print(f"and {len(self.failures) - 20} more")


def check_own_ways():
    """The strips against the polygons, and both against figures by hand: a checker that is wrong finds nothing."""
    square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
    around = [(x - 5, y - 5) for x, y in square]
    near = lambda found, expected: abs(found - expected) < 1e-11 * max(1, expected)
    big = [(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)]
    assert near(own.strip_area(big, None, [square], 0.0), 100)
    assert near(own.strip_area(big, None, [square], 1.0), 64)
    assert near(own.strip_area(big, 3.0, [around], 1.0), 9 * math.pi)
    assert near(own.strip_area(big, 3.0, [[(x, y) for x, y in around], [(-1, -1), (-1, 1), (1, 1), (1, -1)]], 0.0), 9 * math.pi - 4)
    hole = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
    assert near(own.strip_area(big, None, [around, hole], 0.5), 81 - (4 + 4 + math.pi / 4))
    corner = [(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (10.0, 10.0), (10.0, 30.0), (0.0, 30.0)]
    assert near(own.strip_area([(-1, -1), (40, -1), (40, 40), (-1, 40)], None, [corner], 2.0), 280 - math.pi)
    rng = random.Random(1)
    for _ in range(20):
        polygon = big
        for _ in range(6):
            turn = rng.uniform(0, 6.3)
            polygon = own.clipped(polygon, (math.cos(turn), math.sin(turn)), rng.uniform(2, 15))
        assert near(own.strip_area(polygon, None, None, 0.0), own.polygon_area(polygon))


def fitted(program, folder, cases):
    """What the program makes of each case; a sentence where it refuses one."""
    asked, answered = os.path.join(folder, "cases.json"), os.path.join(folder, "out.json")
    with open(asked, "w", encoding="utf-8") as file:
        json.dump({"cases": cases}, file)
    done = subprocess.run([program, "fit", asked, "--json", answered, "--tolerance", str(TOLERANCE)], capture_output=True,
                          text=True)
    if done.returncode in (0, 3):
        with open(answered, encoding="utf-8") as file:
            return json.load(file)["cases"]
    if len(cases) > 1:  # one wrong case leaves all of a file without an answer
        return [result for case in cases for result in fitted(program, folder, [case])]
    return [f"exit code {done.returncode}: {done.stderr.strip().removeprefix(asked)}"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--sets", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--batch", type=int, default=100)
    parser.add_argument("--save", help="folder for the cases that failed")
    options = parser.parse_args()
    check_own_ways()
    tally = Tally()
    with tempfile.TemporaryDirectory() as folder:
        for begin in range(0, options.sets, options.batch):
            numbers = range(begin, min(begin + options.batch, options.sets))
            cases = [random_case(random.Random(options.seed * 1000003 + number)) for number in numbers]
            results = fitted(options.program, folder, cases)
            for number, case, result in zip(numbers, cases, results, strict=True):
                before = len(tally.failures)
                if isinstance(result, str):
                    tally.failures.append(f"set {number}: {result}")
                else:
                    tally.check(number, case, result)
                if options.save and len(tally.failures) > before:
                    with open(os.path.join(options.save, f"set{number}.json"), "w", encoding="utf-8") as file:
                        json.dump(case, file)
    tally.print()
    sys.exit(1 if tally.failures or tally.plates == 0 else 0)


main()
