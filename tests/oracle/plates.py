# Areas of the plates of standing volumes, found by another way than the program's: strips between upright lines, in closed form.
#
# A plate is what its moved half-planes, its disc and the plot share, less all that lies nearer to the border of the plot than its
# set-back: a rectangle along each side of the border and a disc about each corner. Upright lines through every place where two
# of these curves meet cut the plane into strips. In a strip the order of the curves does not change, and each stretch of the
# plate lies between two of them, which are integrated exactly. Where all sides are straight and the plot is convex the polygon
# of the half-planes is enough.
import math


class Line:
    """The side from a to b, not upright."""

    def __init__(self, a, b):
        self.a, self.b = (a, b) if a[0] < b[0] else (b, a)
        self.low, self.high = self.a[0], self.b[0]
        self.slope = (self.b[1] - self.a[1]) / (self.b[0] - self.a[0])

    def at(self, x):
        if 2 * x < self.low + self.high:
            return self.a[1] + self.slope * (x - self.a[0])
        return self.b[1] + self.slope * (x - self.b[0])

    def under(self, x0, x1):
        return self.at((x0 + x1) / 2) * (x1 - x0)


class Arc:
    """The upper (sign 1) or lower (-1) half of a circle."""

    def __init__(self, centre, radius, sign):
        self.centre, self.radius, self.sign = centre, radius, sign
        self.low, self.high = centre[0] - radius, centre[0] + radius

    def at(self, x):
        u = x - self.centre[0]
        return self.centre[1] + self.sign * math.sqrt(max(0.0, (self.radius - u) * (self.radius + u)))

    def under(self, x0, x1):
        def whole(x):
            u = min(self.radius, max(-self.radius, x - self.centre[0]))
            root = math.sqrt((self.radius - u) * (self.radius + u))
            return 0.5 * (u * root + self.radius * self.radius * math.atan2(u, root))
        return self.centre[1] * (x1 - x0) + self.sign * (whole(x1) - whole(x0))


def clipped(polygon, normal, offset):
    """The part of a convex polygon in normal·x <= offset."""
    heights = [normal[0] * x + normal[1] * y - offset for x, y in polygon]
    if all(h <= 0 for h in heights):
        return polygon
    kept = []
    for k, (p, h) in enumerate(zip(polygon, heights)):
        q, g = polygon[k - 1], heights[k - 1]
        if (h <= 0) != (g <= 0):
            t = g / (g - h)
            kept.append((q[0] + t * (p[0] - q[0]), q[1] + t * (p[1] - q[1])))
        if h <= 0:
            kept.append(p)
    return kept if len(kept) > 2 else []


def polygon_area(polygon):
    if not polygon:
        return 0.0
    x0, y0 = polygon[0]
    twice = 0.0
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        twice += (ax - x0) * (by - y0) - (bx - x0) * (ay - y0)
    return twice / 2


def sides_of(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def meetings(a, b):
    """All x where two shapes meet; a shape is ("side", p, q) or ("circle", centre, radius)."""
    if a[0] == "circle" and b[0] == "side":
        a, b = b, a
    if a[0] == "circle":
        dx, dy = b[1][0] - a[1][0], b[1][1] - a[1][1]
        d = math.hypot(dx, dy)
        if d == 0 or d > a[2] + b[2] or d < abs(a[2] - b[2]):
            return []
        along = (d * d + a[2] * a[2] - b[2] * b[2]) / (2 * d)
        across = math.sqrt(max(0.0, a[2] * a[2] - along * along))
        x = a[1][0] + along * dx / d
        return [x - across * dy / d, x + across * dy / d]
    (px, py), (qx, qy) = a[1], a[2]
    ex, ey = qx - px, qy - py
    if b[0] == "side":
        (rx, ry), (sx, sy) = b[1], b[2]
        fx, fy = sx - rx, sy - ry
        det = ex * fy - ey * fx
        if det == 0:
            return []
        t = ((rx - px) * fy - (ry - py) * fx) / det
        u = ((rx - px) * ey - (ry - py) * ex) / det
        return [px + t * ex] if -1e-9 <= t <= 1 + 1e-9 and -1e-9 <= u <= 1 + 1e-9 else []
    length = math.hypot(ex, ey)
    if length == 0:
        return []
    ex, ey = ex / length, ey / length
    gx, gy = b[1][0] - px, b[1][1] - py
    along, height = gx * ex + gy * ey, gx * ey - gy * ex
    if abs(height) > b[2]:
        return []
    half = math.sqrt((b[2] - height) * (b[2] + height))
    return [px + t * ex for t in (along - half, along + half) if -1e-9 <= t <= length + 1e-9]


def lines_of(polygon):
    return [Line(a, b) for a, b in sides_of(polygon) if a[0] != b[0]]


def stretch(lines, x):
    """Where the upright line at x lies in a convex polygon: its lower and its upper side, or None."""
    met = [(line.at(x), line) for line in lines if line.low < x < line.high]
    if len(met) < 2:
        return None
    return min(met, key=lambda m: m[0]), max(met, key=lambda m: m[0])


def strip_area(polygon, radius, rings, setback):
    """Area of what a convex polygon, a disc about the origin (None: none) and rings (None: none), eroded by a set-back, share.
    The set-back is a number, or a function of the two ends of a side."""
    distance = setback if callable(setback) else lambda a, b: setback
    if not polygon:
        return 0.0
    low, high = min(p[0] for p in polygon), max(p[0] for p in polygon)
    bottom, top = min(p[1] for p in polygon), max(p[1] for p in polygon)
    if radius is not None:
        low, high, bottom, top = max(low, -radius), min(high, radius), max(bottom, -radius), min(top, radius)
    if not (low < high and bottom < top):
        return 0.0
    shapes = [("side", a, b) for a, b in sides_of(polygon)]
    if radius is not None:
        shapes.append(("circle", (0.0, 0.0), radius))
    own = lines_of(polygon)
    disc = None if radius is None else (Arc((0.0, 0.0), radius, -1), Arc((0.0, 0.0), radius, 1))
    border, blocked = [], []
    for ring in rings or []:
        for a, b in sides_of(ring):
            if a[0] != b[0]:
                border.append(Line(a, b))
            back = distance(a, b)
            if max(a[0], b[0]) < low - back or min(a[0], b[0]) > high + back:
                continue
            if max(a[1], b[1]) < bottom - back or min(a[1], b[1]) > top + back:
                continue
            shapes.append(("side", a, b))
            if back == 0:
                continue
            length = math.hypot(b[0] - a[0], b[1] - a[1])
            nx, ny = back * (b[1] - a[1]) / length, back * (a[0] - b[0]) / length
            box = [(a[0] + nx, a[1] + ny), (b[0] + nx, b[1] + ny), (b[0] - nx, b[1] - ny), (a[0] - nx, a[1] - ny)]
            blocked.append(lines_of(box))
            shapes += [("side", p, q) for p, q in sides_of(box)]
            for corner in (a, b):
                if ("circle", corner, back) not in shapes:
                    shapes.append(("circle", corner, back))
                    blocked.append((Arc(corner, back, -1), Arc(corner, back, 1)))
    cuts = {low, high}
    for shape in shapes:
        ends = (shape[1][0], shape[2][0]) if shape[0] == "side" else (shape[1][0] - shape[2], shape[1][0] + shape[2])
        cuts.update(x for x in ends if low < x < high)
    for k, a in enumerate(shapes):
        for b in shapes[:k]:
            cuts.update(x for x in meetings(a, b) if low < x < high)
    cuts = sorted(cuts)
    total = []
    for x0, x1 in zip(cuts, cuts[1:]):
        total += strip(x0, x1, own, disc, border if rings is not None else None, blocked)
    return math.fsum(total)


def strip(x0, x1, own, disc, border, blocked):
    x = (x0 + x1) / 2
    if not x0 < x < x1:
        return []
    found = stretch(own, x)
    if found is None:
        return []
    lower, upper = found
    if disc is not None:
        if not disc[0].low < x < disc[0].high:
            return []
        lower = max(lower, (disc[0].at(x), disc[0]), key=lambda m: m[0])
        upper = min(upper, (disc[1].at(x), disc[1]), key=lambda m: m[0])
    free = [(lower, upper)]
    if border is not None:
        crossed = sorted(((line.at(x), line) for line in border if line.low < x < line.high), key=lambda m: m[0])
        free = [(max(lower, a, key=lambda m: m[0]), min(upper, b, key=lambda m: m[0]))
                for a, b in zip(crossed[0::2], crossed[1::2])]
    taken = []
    for shape in blocked:
        if isinstance(shape, tuple):
            if shape[0].low < x < shape[0].high:
                taken.append(((shape[0].at(x), shape[0]), (shape[1].at(x), shape[1])))
        else:
            met = stretch(shape, x)
            if met is not None:
                taken.append(met)
    taken.sort(key=lambda m: m[0][0])
    areas = []
    for begin, end in free:
        for a, b in taken:
            if b[0] <= begin[0] or a[0] >= end[0]:
                continue
            if a[0] > begin[0]:
                areas.append(a[1].under(x0, x1) - begin[1].under(x0, x1))
            begin = b
        if end[0] > begin[0]:
            areas.append(end[1].under(x0, x1) - begin[1].under(x0, x1))
    return areas


def is_along(a, b, streets):
    """Does the side from a to b run along a street: its middle within reach, and the same direction within 30 degrees?"""
    mx, my = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    ux, uy = b[0] - a[0], b[1] - a[1]
    for street in streets:
        for (cx, cy), (dx, dy) in zip(street["points"], street["points"][1:]):
            vx, vy = dx - cx, dy - cy
            if abs(ux * vx + uy * vy) < math.cos(math.radians(30)) * math.hypot(ux, uy) * math.hypot(vx, vy):
                continue
            t = min(1.0, max(0.0, ((mx - cx) * vx + (my - cy) * vy) / (vx * vx + vy * vy)))
            if math.hypot(mx - cx - t * vx, my - cy - t * vy) <= street["reach"]:
                return True
    return False


def moved_in(form, setback, courtyard=None):
    """How far each kind of side moves in: the form's own, those towards neighbours, the border of the plot and streets."""
    sides = form.get("sides", {})
    party, fire = sides.get("party_walls", False), sides.get("border_walls", False)
    own, wing = 0.0, 0.0
    if courtyard is not None:
        own = max(0.0, form["depth"] - courtyard)
        wing = max(0.0, min(form["depth"], sides.get("wing_depth", math.inf)) - courtyard)
    return {"own": setback + own, "neighbour": (0.0 if party else setback) + (wing if party else own),
            "border": sides.get("border", 0.0) + (0.0 if fire else setback) + (wing if fire else own),
            "street": sides.get("street", 0.0) + setback + own}


def rest_area(case, i, weights, offsets):
    """What is left of the footprint of site i with its sides moved in by `offsets`: the area, and by which way it was found."""
    form, (px, py, _) = case["form"], case["sites"][i]
    offset, streets = offsets["own"], form.get("sides", {}).get("streets", [])
    own = weights[i]
    rings = [[(x - px, y - py) for x, y in ring] for ring in [case["boundary"]["plan"]] + case["boundary"]["holes"]]
    radius = None
    xs, ys = [p[0] for p in rings[0]], [p[1] for p in rings[0]]
    polygon = [(min(xs) - 1, min(ys) - 1), (max(xs) + 1, min(ys) - 1), (max(xs) + 1, max(ys) + 1), (min(xs) - 1, max(ys) + 1)]
    if form["kind"] != "cell" and not own > 0:
        return 0.0, True
    if form["kind"] == "round":
        radius = math.sqrt(own) - offset
        if not radius > 0:
            return 0.0, True
        polygon = [(-radius, -radius), (radius, -radius), (radius, radius), (-radius, radius)]
    if form["kind"] == "block":
        turn = math.radians(form["angle"])
        cosine, sine = math.cos(turn), math.sin(turn)
        a, b = math.sqrt(own * form["aspect"]) - offset, math.sqrt(own / form["aspect"]) - offset
        if not (a > 0 and b > 0):
            return 0.0, True
        polygon = [(s * a * cosine - t * b * sine, s * a * sine + t * b * cosine) for s, t in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    for j, (qx, qy, _) in enumerate(case["sites"]):
        if j == i:
            continue
        dx, dy = qx - px, qy - py
        d = math.hypot(dx, dy)
        polygon = clipped(polygon, (dx / d, dy / d), (d * d + own - weights[j]) / (2 * d) - offsets["neighbour"])
        if not polygon:
            return 0.0, True
    at = lambda a, b: offsets["street" if is_along((a[0] + px, a[1] + py), (b[0] + px, b[1] + py), streets) else "border"]
    backs = {at(a, b) for ring in rings for a, b in sides_of(ring)}
    if not case["convex"] or len(backs) > 1:
        return strip_area(polygon, radius, rings, at), False
    back = backs.pop()
    for (ax, ay), (bx, by) in sides_of(rings[0]):
        length = math.hypot(bx - ax, by - ay)
        nx, ny = (by - ay) / length, (ax - bx) / length
        polygon = clipped(polygon, (nx, ny), nx * ax + ny * ay - back)
    if radius is None:
        return polygon_area(polygon), True
    return strip_area(polygon, radius, None, 0.0), False


def plates(case, i, weights):
    """The plates of site i from the ground up, and whether all of their sides are straight and the plot convex."""
    form, areas, kept, straight = case["form"], [], {}, True
    for storey in range(form["storeys"][i]):
        setbacks = form["setbacks"]
        setback = setbacks[min(storey, len(setbacks) - 1)] if setbacks else 0.0
        courtyards = form.get("sides", {}).get("courtyards") or [0.0]
        courtyard = courtyards[min(storey, len(courtyards) - 1)]
        if (setback, courtyard) not in kept:
            area, is_straight = rest_area(case, i, weights, moved_in(form, setback))
            straight &= is_straight
            if form["depth"] is not None and area > 0:
                court, is_straight = rest_area(case, i, weights, moved_in(form, setback, courtyard))
                area -= court
                straight &= is_straight
            kept[setback, courtyard] = area
        areas.append(kept[setback, courtyard])
    return areas, straight
