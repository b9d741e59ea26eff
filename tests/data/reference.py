# Writes reference_cells.json and reference_fits.json: balls in boxes, by quadrature with forty digits and without any polyhedron.
#
# Sites in a grid whose weights are sums u[i] + v[j] + w[k] divide space into boxes, so that every shape is a ball cut by three
# pairs of parallel planes. Of the disc in which a plane meets the ball, and of its circle, closed forms say what lies in a
# rectangle; one integral over these gives the volume and the spherical area. A turn by rational numbers makes the planes slant.
import json
import os
from fractions import Fraction as F

from mpmath import acos, asin, mp, mpf, pi, quad, sqrt

mp.dps = 40


def clamp(x, low, high):
    return max(low, min(high, x))


def disc_in_rectangle(radius, low, high):
    """Area of a disc around the origin inside [low[0], high[0]] x [low[1], high[1]], the origin inside as well."""
    def half(a, b, c):  # area below the circle and below c > 0, for a < y < b
        def under_circle(y):
            y = clamp(y, -radius, radius)
            return (y * sqrt(max(mpf(0), radius**2 - y**2)) + radius**2 * asin(y / radius)) / 2
        a, b = clamp(a, -radius, radius), clamp(b, -radius, radius)
        if c >= radius:
            return under_circle(b) - under_circle(a)
        q = sqrt(radius**2 - c**2)
        left, right = clamp(-q, a, b), clamp(q, a, b)
        return under_circle(left) - under_circle(a) + c * (right - left) + under_circle(b) - under_circle(right)
    return half(low[0], high[0], high[1]) + half(low[0], high[0], -low[1])


def arc_in_rectangle(radius, low, high):
    """Angle of a circle around the origin inside the same rectangle: the whole less four arcs, where corners do not overlap."""
    quarters = 0
    for x in (-low[0], high[0]):
        for y in (-low[1], high[1]):
            beyond_x = acos(min(mpf(1), x / radius))
            beyond_y = acos(min(mpf(1), y / radius))
            quarters += max(mpf(0), pi / 2 - beyond_x - beyond_y)
    return quarters


def ball_in_box(radius, low, high):
    """Volume, spherical area and the areas on the sides -x +x -y +y -z +z; the box holds the ball's centre, the origin."""
    a, b = max(low[0], -radius), min(high[0], radius)
    kinks = {a, b, mpf(0)}
    for y in (low[1], high[1]):
        for z in (low[2], high[2], mpf(0)):
            for square in (radius**2 - y**2 - z**2, radius**2 - z**2):
                if square > 0:
                    kinks |= {x for x in (sqrt(square), -sqrt(square)) if a < x < b}
    kinks = sorted(kinks)
    section = lambda x: sqrt(max(mpf(0), radius**2 - x**2))
    inside = lambda x: disc_in_rectangle(section(x), low[1:], high[1:]) if section(x) > 0 else mpf(0)
    around = lambda x: radius * arc_in_rectangle(section(x), low[1:], high[1:]) if section(x) > 0 else mpf(0)
    volume, surface = quad(inside, kinks), quad(around, kinks)
    areas, flux = [], radius * surface
    for axis in range(3):
        rest = [k for k in range(3) if k != axis]
        for at in (low[axis], high[axis]):
            area = mpf(0)
            if abs(at) < radius:
                area = disc_in_rectangle(section(at), [low[k] for k in rest], [high[k] for k in rest])
            areas.append(area)
            flux += abs(at) * area
    assert abs(flux / 3 - volume) < mpf(10)**-30 * volume, "the divergence theorem"
    return volume, surface, areas


TURN_BY = (1, 2, 3, 4)  # a quaternion: its matrix is rational


def turned(p, is_turned):
    if not is_turned:
        return p
    a, b, c, d = (F(k) for k in TURN_BY)
    n = a * a + b * b + c * c + d * d
    rows = [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]
    return [sum(r * x for r, x in zip(row, p)) / n for row in rows]


def case(name, low, high, grid, weights, is_turned=False):
    """`grid` and `weights`: per axis the places of sites, and what each adds to their weights."""
    number = lambda x: mpf(x.numerator) / mpf(x.denominator)
    walls = []  # per axis: the borders between neighbours along it, the box's own at the ends
    for axis in range(3):
        g, w = grid[axis], weights[axis]
        between = [(g[i] + g[i + 1] + (w[i] - w[i + 1]) / (g[i + 1] - g[i])) / 2 for i in range(len(g) - 1)]
        walls.append([low[axis]] + between + [high[axis]])
    planes = []
    for axis in range(3):
        for sign, at in ((-1, low[axis]), (1, high[axis])):
            normal = turned([F(sign if k == axis else 0) for k in range(3)], is_turned)
            planes.append([float(x) for x in normal] + [float(sign * at)])
    count = [len(g) for g in grid]
    index = lambda i, j, k: (i * count[1] + j) * count[2] + k
    sites, site_weights, cells, demands = [], [], [], []
    for i in range(count[0]):
        for j in range(count[1]):
            for k in range(count[2]):
                place = (i, j, k)
                centre = [grid[axis][place[axis]] for axis in range(3)]
                weight = sum(weights[axis][place[axis]] for axis in range(3))
                box_low = [number(walls[axis][place[axis]] - centre[axis]) for axis in range(3)]
                box_high = [number(walls[axis][place[axis] + 1] - centre[axis]) for axis in range(3)]
                assert all(x < 0 for x in box_low) and all(x > 0 for x in box_high), "each site lies in its own cell"
                volume, surface, areas = ball_in_box(sqrt(number(weight)), box_low, box_high)
                facets = {}
                for side in range(6):
                    axis, is_high = divmod(side, 2)
                    other = list(place)
                    other[axis] += 1 if is_high else -1
                    is_wall = not 0 <= other[axis] < count[axis]
                    if areas[side] > 0:
                        facets[f"plane:{side}" if is_wall else f"site:{index(*other)}"] = mp.nstr(areas[side], 20)
                cells.append({"site": len(sites), "volume": mp.nstr(volume, 20), "spherical_area": mp.nstr(surface, 20),
                              "facet_areas": facets})
                sites.append([float(x) for x in turned(centre, is_turned)])
                site_weights.append(float(weight))
                demands.append(float(volume))
    return {"name": name, "boundary": {"planes": planes}, "sites": sites, "weights": site_weights, "cells": cells,
            "demands": demands}


E = F(1, 64)
GRID = ([F(1, 4), F(3, 4)], [F(5, 16), F(3, 4)], [F(1, 4), F(11, 16)])
PARTS = ([3 * E, 2 * E], [E, 2 * E], [E, 2 * E])
ONE = [F(1)] * 3
CASES = [
    case("ball inside", [F(0)] * 3, ONE, ([F(1, 2)],) * 3, ([F(3, 32)], [F(0)], [F(0)])),
    case("ball through six walls", [F(0)] * 3, ONE, ([F(7, 16)], [F(1, 2)], [F(9, 16)]), ([F(11, 32)], [F(0)], [F(0)])),
    case("three in a row", [F(0)] * 3, [F(3), F(1), F(1)], ([F(1, 2), F(5, 4), F(5, 2)], [F(1, 2)], [F(3, 8)]),
         ([F(1, 4), F(3, 8), F(1, 2)], [F(0)], [F(0)])),
    case("eight in a cube", [F(0)] * 3, ONE, GRID, PARTS),
    case("eight in a turned cube", [F(0)] * 3, ONE, GRID, PARTS, is_turned=True),
    case("eighteen in a turned box", [F(-1)] * 3, [F(2), F(1), F(1)],
         ([F(-1, 2), F(1, 2), F(11, 8)], [F(-5, 8), F(0), F(1, 2)], [F(-1, 2), F(3, 8)]),
         ([F(1, 8), F(3, 16), F(1, 8)], [F(1, 16), F(0), F(1, 16)], [F(1, 16), F(1, 8)]), is_turned=True),
]


def write(name, cases, fields):
    folder = os.path.dirname(os.path.abspath(__file__))
    lines = [json.dumps({field: given[field] for field in fields}) for given in cases]
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write('{"cases": [\n' + ",\n".join(lines) + "\n]}\n")


write("reference_cells.json", CASES, ["name", "boundary", "sites", "weights", "cells"])
write("reference_fits.json", CASES, ["name", "boundary", "sites", "weights", "demands"])
for given in CASES:
    print(given["name"], len(given["sites"]), "sites, fill", sum(given["demands"]))
