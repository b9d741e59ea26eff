"""Draws the small pictures that the shipped scenes show: an elevation of three houses, and the same lying on its side."""
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


if __name__ == "__main__":
    write("houses.png", WIDTH, HEIGHT, pixel)
    write("houses_turned.png", HEIGHT, WIDTH, lambda x, y: pixel(y, HEIGHT - 1 - x))
