#!/usr/bin/env python3
"""Makes the walk of twenty people through a hall: python3 hall_walk.py > hall_walk.csv. No measurement of anybody is in it."""

HALL = (18.0, 12.0)  # m
DOORS = ((0.3, 6.0), (17.7, 4.0))
STEP = 0.5  # s
PEOPLE = 20


def numbers(seed):
    """The same numbers on every machine, from 0 up to 1: a linear congruence with the constants of Numerical Recipes."""
    while True:
        seed = (1664525 * seed + 1013904223) % 2**32
        yield seed / 2**32


def walk(person, random):
    """Comes in by a door, looks at a few places, stays a while at each, and goes out: (seconds, place) every half second."""
    draw = lambda low, high: low + (high - low) * next(random)
    time = round(draw(0, 60) / STEP) * STEP if person > 0 else 0.0
    place = DOORS[int(next(random) * 2)]
    goals = [(draw(1.5, HALL[0] - 1.5), draw(1.5, HALL[1] - 1.5)) for _ in range(2 + int(next(random) * 3))]
    goals.append(DOORS[int(next(random) * 2)])
    speed = draw(0.9, 1.5)  # m/s
    for goal in goals:
        while place != goal:
            yield time, place
            distance = ((goal[0] - place[0]) ** 2 + (goal[1] - place[1]) ** 2) ** 0.5
            share = min(1.0, speed * STEP / distance)
            place = goal if share == 1.0 else tuple(a + (b - a) * share for a, b in zip(place, goal))
            time += STEP
        yield time, place
        time += round(draw(3, 10) / STEP) * STEP if goal != goals[-1] else STEP
    yield time, None


def main():
    random = numbers(1)
    rows = []
    for person in range(PEOPLE):
        last = ""
        for time, place in walk(person, random):
            text = "," if place is None else f"{place[0]:.2f},{place[1]:.2f}"
            if text != last:
                rows.append((time, person, text))
            last = text
    rows.sort(key=lambda row: row[:2])
    print("time,person,x,y")
    for time, person, text in rows:
        print(f"{time:g},p{person + 1:02d},{text}")


main()
