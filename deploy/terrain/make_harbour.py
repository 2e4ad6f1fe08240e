#!/usr/bin/env python3
"""An island with a beach, a bay and a harbour, as an ESRI ASCII grid.   make_harbour.py OUT.asc.gz

Our own invention; no place on earth. 2 km x 2 km, a sample every 5 m, the origin in the middle:
outside 20 to 30 m deep, the harbour (400 m x 300 m, 4 to 8 m deep) between two breakwaters south of
the island, its mouth to the south-east; a bay with a beach in the west, rocks in the north, an
islet and a shoal off shore.
"""
import gzip
import math
import sys

SIDE, CELL = 401, 5.0
ISLAND = (230.0, 430.0)

# Crest lines of the breakwaters, from the shore outwards.
WEST_ARM = [(-140, 120), (-150, -40), (-140, -160), (-95, -235), (0, -280), (110, -300), (215, -300)]
EAST_ARM = [(375, 120), (365, 0), (350, -110), (300, -195)]
JETTY = [(120, 90), (120, -70)]
BASIN = (-120.0, -250.0, 330.0, 50.0)  # west, south, east, north


def smooth(edge0, edge1, x):
    """0 at edge0, 1 at edge1, in either order of the two."""
    t = min(1.0, max(0.0, (x - edge0) / (edge1 - edge0)))
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return a + (b - a) * t


def lattice(i, j):
    """A number in [-1, 1] of a lattice point, the same everywhere."""
    h = (i * 374761393 + j * 668265263) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 32767.5 - 1.0


def noise(x, y):
    i, j = math.floor(x), math.floor(y)
    u, v = smooth(0, 1, x - i), smooth(0, 1, y - j)
    return mix(mix(lattice(i, j), lattice(i + 1, j), u), mix(lattice(i, j + 1), lattice(i + 1, j + 1), u), v)


def hills(x, y, scale, octaves):
    return sum(noise(x / scale * 2**n + 17 * n, y / scale * 2**n) / 2**n for n in range(octaves))


def distance_to_line(x, y, points):
    best = math.inf
    for (ax, ay), (bx, by) in zip(points, points[1:]):
        dx, dy = bx - ax, by - ay
        t = min(1.0, max(0.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
        best = min(best, math.hypot(x - ax - t * dx, y - ay - t * dy))
    return best


def inland(x, y):
    """Metres from the island's shore, positive on land."""
    dx, dy = x - ISLAND[0], y - ISLAND[1]
    phi = math.atan2(dy, dx)
    radius = 400 * (1 + 0.13 * math.cos(2 * phi - 0.4) + 0.06 * math.cos(3 * phi + 1.1)
                    + 0.03 * math.cos(5 * phi + 0.3))
    island = radius - math.hypot(dx, dy) + 30 * hills(x, y, 150, 4)
    # The bay bites a round piece out of the west coast.
    bay = max(math.hypot(x + 215, y - 420) - 190 + 8 * hills(x, y, 70, 2), -80.0)
    k = 40.0
    nearer, gap = min(island, bay), abs(island - bay)
    return nearer - k * math.log1p(math.exp(-gap / k))


def natural(x, y):
    s = inland(x, y)
    rocky = smooth(560, 720, y)
    if s >= 0:
        beach = 0.055 * s if s < 40 else 2.2 + 26 * (1 - math.exp(-((s - 40) / 170)**1.6))
        cliff = 9 * (1 - math.exp(-s / 9)) + 24 * (1 - math.exp(-(s / 150)**1.5))
        e = mix(beach, cliff, rocky) + smooth(40, 160, s) * 5 * hills(x, y, 180, 4)
    else:
        # The south is a shelf: the harbour stands on it.
        d = -s * (1 - 0.6 * math.exp(-((x - 110) / 380)**2) * smooth(200, -60, y))
        sand = 0.11 * d**0.82 if d < 60 else 0.11 * 60**0.82 + 24.5 * (1 - math.exp(-(d - 60) / 230))
        rock = 27 * (1 - math.exp(-d / 55))
        far = smooth(120, 420, d)
        e = -mix(sand, rock, rocky) + far * 1.6 * hills(x, y, 260, 3) + rocky * (1 - far) * 1.2 * hills(x, y, 30, 2)
    # An islet and a shoal.
    r = math.hypot(x + 640, y - 130) + 14 * hills(x, y, 60, 3)
    e = max(e, 11 - 0.36 * r) if r < 110 else e
    r = math.hypot((x + 520) / 1.6, y + 380)
    e += 20.5 * math.exp(-(r / 75)**2)
    return e


def breakwater(distance, crest, half_width, slope):
    return crest - max(0.0, distance - half_width) / slope


def elevation(x, y):
    e = natural(x, y)
    west, south, east, north = BASIN
    # Quays and the ground behind them.
    if west - 30 < x < east + 50 and north <= y < north + 75:
        e = max(e, 2.6)
    # The basin and the channel to its mouth, dredged and filled.
    inside = min(x - west, east - x, (y - south) / 2, north - y)
    floor = -(4.3 + 3.2 * smooth(north, south + 60, y) + 0.15 * hills(x, y, 50, 2))
    if inside > 0:
        e = floor if y > north - 25 else mix(e, floor, smooth(0, 25, inside))
    channel = distance_to_line(x, y, [(150, -150), (262, -262), (520, -480)])
    e = min(e, mix(-7.9 - 0.012 * max(0.0, x - 200), e, smooth(25, 110, channel)))
    for arm in (WEST_ARM, EAST_ARM):
        e = max(e, breakwater(distance_to_line(x, y, arm), 3.4, 6.0, 1.7) + 0.25 * hills(x, y, 9, 2))
    if distance_to_line(x, y, JETTY) < 6:
        e = max(e, 2.2)
    return e


def main():
    rows = []
    for j in reversed(range(SIDE)):
        y = (j - SIDE // 2) * CELL
        row = []
        for i in range(SIDE):
            e = elevation((i - SIDE // 2) * CELL, y)
            # Decimetres, finer where waves break.
            row.append(f"{e:.2f}" if -3 < e < 1.5 else f"{e:.1f}")
        rows.append(" ".join(row))
    half = SIDE // 2 * CELL
    text = (f"ncols {SIDE}\nnrows {SIDE}\nxllcenter {-half}\nyllcenter {-half}\ncellsize {CELL}\n"
            + "\n".join(rows) + "\n")
    with open(sys.argv[1], "wb") as out:
        out.write(gzip.compress(text.encode(), 9, mtime=0))


if __name__ == "__main__":
    main()
