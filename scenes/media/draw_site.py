"""Draws the small pictures that the shipped scenes show: an elevation of three houses, the same lying on its side, and a day of it."""
import struct
import zlib

WIDTH, HEIGHT = 160, 100


def pixel(x, y):
    if y > 86:
        return (150, 148, 140)
    for left, right, top, wall in ((8, 50, 40, (196, 120, 92)), (52, 104, 22, (222, 206, 170)), (106, 152, 48, (120, 140, 160))):
        if left <= x < right and y >= top:
            column, row = (x - left - 4) % 12, (y - top - 6) % 15
            is_window = column < 7 and row < 9 and left + 4 <= x < right - 3 and top + 6 <= y < 82
            return (60, 74, 92) if is_window else wall
    shade = 255 - y // 2
    return (shade - 60, shade - 30, shade)


def write(path, width, height, at):
    rows = b"".join(b"\0" + bytes(v for x in range(width) for v in at(x, y)) for y in range(height))
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


# From dawn to night: how bright the sky is, how warm, and which windows are lit.
DAY_FRAMES = 8


def day(frame):
    hour = frame / DAY_FRAMES
    bright = max(0.0, 1 - (2 * hour - 0.85) ** 2 * 1.6)
    warm = max(0.0, 1 - 4 * abs(bright - 0.45))
    sun = (20 + 17 * frame, 70 - int(62 * bright))

    def at(x, y):
        r, g, b = pixel(x, y)
        is_house = y <= 86 and (r, g, b) != pixel(0, y)
        if not is_house and y <= 86 and bright > 0.15 and (x - sun[0]) ** 2 + (y - sun[1]) ** 2 < 40:
            return (255, 236, 170)
        if (r, g, b) == (60, 74, 92) and bright < 0.5 and (x * 7 // 12 + y // 15) % 3 != 0:
            return (250, 214, 120)
        shine = 0.25 + 0.75 * bright
        return tuple(int(min(255, v * shine + add * warm)) for v, add in ((r, 40), (g, 14), (b, 0)))

    return at


if __name__ == "__main__":
    write("houses.png", WIDTH, HEIGHT, pixel)
    for number in range(DAY_FRAMES):
        write(f"day_{number + 1}.png", WIDTH, HEIGHT, day(number))
    write("houses_turned.png", HEIGHT, WIDTH, lambda x, y: pixel(y, HEIGHT - 1 - x))
