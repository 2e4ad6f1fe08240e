"""Two viewers at one server: one drives a boat by its own keys, the other watches. Same boat, same wake."""

import csv
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

from onesea_process import BIN, ROOT, Server

SESSION = ROOT / "deploy" / "sessions" / "calm-swell.textproto"
SIZE = (320, 180)


def poses(path):
    with open(path, newline="") as file:
        return [{key: value if key == "name" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def at(rows, time_s):
    """Place between the two rows around a time; None outside of them."""
    for before, after in zip(rows, rows[1:]):
        if before["time_s"] <= time_s < after["time_s"] and after["time_s"] - before["time_s"] < 0.5:
            share = (time_s - before["time_s"]) / (after["time_s"] - before["time_s"])
            return [before[axis] + share * (after[axis] - before[axis]) for axis in ("x_m", "y_m", "z_m")]
    return None


def read_png(path):
    """Rows of RGB bytes of an 8-bit PNG that isn't interlaced."""
    data, position, packed = pathlib.Path(path).read_bytes(), 8, b""
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        body = data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour, body[12]) == (8, 2, 0), "not the PNG that the viewer writes"
        if kind == b"IDAT":
            packed += body
        position += 12 + length
    raw, stride, rows, last = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for n in range(stride):
            left, up, corner = (line[n - 3], last[n], last[n - 3]) if n >= 3 else (0, last[n], 0)
            if kind == 1:
                line[n] = (line[n] + left) & 255
            elif kind == 2:
                line[n] = (line[n] + up) & 255
            elif kind == 3:
                line[n] = (line[n] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up),
                              (abs(guess - corner), 2, corner))[2]
                line[n] = (line[n] + nearest) & 255
        rows.append(bytes(line))
        last = rows[-1]
    return rows


def white_share(rows):
    """Of the pixels below the middle: grey and bright, as foam is and dark water isn't."""
    white = count = 0
    for row in rows[len(rows) * 6 // 10:]:
        for n in range(0, len(row), 3):
            low, high = min(row[n:n + 3]), max(row[n:n + 3])
            white += low > 110 and high - low < 60
            count += 1
    return white / count


class Driving(unittest.TestCase):
    def viewer(self, server, folder, *words):
        return subprocess.Popen(
            [str(BIN / "onesea-view"), f"--server={server.address}", "--headless", f"--size={SIZE[0]}x{SIZE[1]}",
             f"--out={folder}", f"--poses={folder}.csv", *words],
            cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={"PATH": "/usr/bin:/bin"})

    def test_a_driven_boat_is_the_same_for_a_watcher(self):
        with tempfile.TemporaryDirectory() as folder, Server(SESSION) as server:
            driver = self.viewer(server, f"{folder}/driver", "--drive=0=b,1.5=up,7=up+left,8=up", "--seconds=12",
                                 "--fps=1", "--sun-azimuth=250", "--clouds=0.1")
            watcher = self.viewer(server, f"{folder}/watcher", "--live", "--seconds=12", "--fps=0.2")
            for viewer in (driver, watcher):
                words, _ = viewer.communicate(timeout=100)
                self.assertEqual(viewer.returncode, 0, words)

            own = [row for row in poses(f"{folder}/driver.csv") if row["own"] == 1]
            self.assertGreater(len(own), 20)
            seen = [row for row in poses(f"{folder}/watcher.csv") if row["id"] == own[0]["id"]]
            self.assertTrue(all(row["own"] == 0 for row in seen))
            way_m = sum(abs(b["x_m"] - a["x_m"]) + abs(b["y_m"] - a["y_m"]) for a, b in zip(own, own[1:]))
            self.assertGreater(way_m, 10.0)
            apart_m = []
            for row in own:
                other = at(seen, row["time_s"])
                if other is not None:
                    apart_m.append(sum((row[axis] - there) ** 2
                                       for axis, there in zip(("x_m", "y_m", "z_m"), other)) ** 0.5)
            self.assertGreater(len(apart_m), 20)
            apart_m.sort()
            print(f"{len(apart_m)} poses compared, median {apart_m[len(apart_m) // 2]:.3f} m apart, "
                  f"nine of ten within {apart_m[len(apart_m) * 9 // 10]:.3f} m, way {way_m:.1f} m")
            # Pictures of this machine may come late; a boat that isn't the same is metres away.
            self.assertLess(apart_m[len(apart_m) // 2], 0.25)
            self.assertLess(apart_m[len(apart_m) * 9 // 10], 0.6)

            pictures = sorted(pathlib.Path(f"{folder}/driver").glob("*.png"))
            shares = [white_share(read_png(picture)) for picture in pictures]
            print("white share below the middle:", " ".join(f"{100 * share:.2f}" for share in shares), "%")
            self.assertLess(shares[0], 0.005)  # no boat, no wake
            self.assertGreater(max(shares[-2:]), 0.01)

            # Who left let go of the boat.
            bodies = server.ask("bodies")["bodies"]
            self.assertEqual([body["driver"] for body in bodies if body["id"] == own[0]["id"]], [""])

    def test_nonsense_is_refused_in_words(self):
        for words, expected in ((["--drive=0=jump"], "no key 'jump'"), (["--drive=3=up,1=b"], "ascend"),
                                (["--drive=0=b", "--headless=false"], "--headless"), (["--poses=/nowhere/p.csv"], "write")):
            finished = subprocess.run(
                [str(BIN / "onesea-view"), f"--offline={SESSION}", "--headless", "--seconds=0.1", "--size=64x64",
                 "--out=/tmp/unused-by-driving-test", *words], cwd=ROOT, capture_output=True, text=True, timeout=60)
            self.assertEqual(finished.returncode, 1, finished.stdout)
            self.assertIn(expected, finished.stderr)


if __name__ == "__main__":
    unittest.main()
