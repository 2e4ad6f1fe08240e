"""The real `onesea` command against a real server: text, --json, help as printed, and nonsense."""

import csv
import json
import math
import pathlib
import re
import shlex
import signal
import subprocess
import tempfile
import unittest

from onesea_process import BIN, ROOT, Server, free_port

SERVER = None


def setUpModule():
    global SERVER
    SERVER = Server().start()


def tearDownModule():
    SERVER.stop()


class Commands(unittest.TestCase):
    def tearDown(self):
        # Every test leaves the default session running at speed 1, and no other session.
        self.assertIsNone(SERVER.process.poll(), SERVER.output())
        for session in SERVER.ask("sessions")["sessions"]:
            if session["name"].startswith("tank"):
                SERVER.onesea("delete", session["name"])

    def test_sessions_shows_the_measured_storm(self):
        sessions = SERVER.ask("sessions")["sessions"]
        self.assertEqual(len(sessions), 1)
        # NDBC published Hs 4.71 m for this record.
        self.assertAlmostEqual(sessions[0]["hs_m"], 4.71, delta=0.05)
        self.assertEqual(sessions[0]["tick_rate_hz"], 60)
        text = SERVER.onesea("sessions").stdout
        self.assertIn(sessions[0]["name"], text)
        self.assertIn(sessions[0]["component_hash"], text)

    def test_local_heights_are_the_servers(self):
        for time_s in ("0", "1234.5", "-50", "86400"):
            answer = SERVER.ask("query", "--at", "0,0", "--at", "-120.5,33", "--at", "4000,-2500", "--time", time_s,
                                "--local")
            self.assertEqual(answer["time_s"], float(time_s))
            self.assertGreater(answer["height_error_bound_m"], 0.0)
            self.assertLess(answer["height_error_bound_m"], 0.5)
            for point in answer["points"]:
                self.assertEqual(point["difference_m"], 0.0)
                self.assertLess(abs(point["height_m"]), 12.0)
            # Different places must not answer alike, or the comparison says nothing.
            self.assertEqual(len({point["height_m"] for point in answer["points"]}), 3)

    def test_depth_answers_agree_and_fade_downwards(self):
        pressures = []
        for depth in ("6", "60"):
            words = ["query", "--at", "10,20", "--time", "77", "--depth", depth, "--detail", "velocity"]
            remote = SERVER.ask(*words)["points"][0]
            local = SERVER.ask(*words, "--local")["points"][0]
            self.assertAlmostEqual(remote["dynamic_pressure_pa"], local["dynamic_pressure_pa"], delta=1.0)
            for axis in range(3):
                self.assertAlmostEqual(remote["velocity_m_per_s"][axis], local["velocity_m_per_s"][axis], delta=1e-4)
                self.assertAlmostEqual(remote["depth_velocity_m_per_s"][axis], local["depth_velocity_m_per_s"][axis],
                                       delta=1e-4)
            self.assertAlmostEqual(math.hypot(*remote["normal"]), 1.0, delta=1e-5)
            pressures.append(abs(remote["dynamic_pressure_pa"]))
        self.assertLess(pressures[1], pressures[0])

    def test_watch_follows_without_drift(self):
        finished = SERVER.onesea("watch", "--seconds", "3", "--json")
        self.assertEqual(finished.returncode, 0, finished.stderr)
        readings = [json.loads(line) for line in finished.stdout.splitlines()]
        self.assertEqual(len(readings), 3)
        last = readings[-1]
        self.assertTrue(last["connected"])
        self.assertGreaterEqual(last["comparisons"], 1)
        self.assertEqual(last["worst_drift_m"], 0.0)
        self.assertGreater(last["tick"], readings[0]["tick"])
        self.assertEqual(last["component_hash"], SERVER.ask("hash")["component_hash"])
        text = SERVER.onesea("watch", "--seconds", "1").stdout
        self.assertRegex(text, r"tick \d+ .*clock ±[\d.]+ ms, drift .*bytes/s")

    def test_hold_step_resume(self):
        held = SERVER.ask("hold")["tick"]
        self.assertEqual(SERVER.ask("hash")["tick"], held)
        stepped = SERVER.ask("step", "7")
        self.assertEqual(stepped["tick"], held + 7)
        self.assertEqual(SERVER.ask("hash")["tick"], held + 7)
        SERVER.ask("resume")
        refused = SERVER.onesea("step", "1")
        self.assertEqual(refused.returncode, 1)
        self.assertEqual(SERVER.ask("sessions")["sessions"][0]["pace"], "real time")

    def test_speed(self):
        self.assertEqual(SERVER.ask("speed", "2.5")["speed"], 2.5)
        self.assertEqual(SERVER.ask("sessions")["sessions"][0]["speed"], 2.5)
        self.assertEqual(SERVER.ask("speed", "1")["speed"], 1.0)

    def test_create_and_delete(self):
        made = SERVER.ask("create", "deploy/sessions/tank.textproto", "--session", "tank-7")
        self.assertEqual(made["name"], "tank-7")
        ambiguous = SERVER.onesea("hash")
        self.assertEqual(ambiguous.returncode, 1)
        self.assertIn("--session", ambiguous.stderr)
        self.assertIn("tank-7", ambiguous.stderr)
        self.assertNotEqual(SERVER.ask("hash", "--session", "tank-7")["component_hash"], "0" * 16)
        twice = SERVER.onesea("create", "deploy/sessions/tank.textproto", "--session", "tank-7")
        self.assertEqual(twice.returncode, 1)
        SERVER.ask("delete", "tank-7")
        self.assertEqual(SERVER.onesea("delete", "tank-7").returncode, 1)


class World(unittest.TestCase):
    """A session of its own: bodies, walls, regions, instruments."""

    @classmethod
    def setUpClass(cls):
        SERVER.ask("create", "deploy/sessions/calm-swell.textproto", "--session", "tank-world")
        SERVER.ask("hold", "--session", "tank-world")

    @classmethod
    def tearDownClass(cls):
        SERVER.onesea("delete", "tank-world")

    def ask(self, *words):
        return SERVER.ask(*words, "--session", "tank-world")

    def body(self, number):
        return next(body for body in self.ask("bodies")["bodies"] if body["id"] == number)

    def test_an_impulse_moves_a_crate_by_its_share(self):
        crate = self.ask("spawn", "crate", "--at", "60,60", "--no-wake")["id"]
        self.assertEqual(self.body(crate)["speed_m_per_s"], 0.0)
        self.ask("impulse", str(crate), "--by", "120,0,0")
        self.ask("step", "1")
        # 240 kg and some water that moves along.
        self.assertGreater(self.body(crate)["speed_m_per_s"], 0.2)
        self.assertLess(self.body(crate)["speed_m_per_s"], 0.5)
        self.ask("remove", str(crate))

    def test_presets_are_what_spawn_takes(self):
        for preset in self.ask("presets")["presets"]:
            made = self.ask("spawn", preset["name"], "--at", "-80,40", "--no-wake")
            self.assertEqual(self.body(made["id"])["name"], preset["name"])
            self.ask("remove", str(made["id"]))

    def test_walls_and_regions_come_and_go(self):
        wall = self.ask("obstacle", "--corner", "0,0", "--corner", "4,0", "--corner", "4,4")["id"]
        self.assertEqual(self.ask("obstacle", "--corner", "0,0", "--corner", "4,0", "--corner", "0,4", "--replace",
                                  str(wall))["id"], wall)
        self.ask("obstacle", "--remove", str(wall))
        region = self.ask("region", "--at", "0,0", "--cells", "64x96", "--cell", "0.25", "--solver", "iwave",
                          "--damping", "0.1")["id"]
        self.ask("region", "--remove", str(region))
        for words in (["obstacle", "--remove", str(wall)], ["region", "--remove", str(region)],
                      ["region", "--follow", "999"]):
            gone = SERVER.onesea(*words, "--session", "tank-world")
            self.assertEqual(gone.returncode, 1, words)
            self.assertIn("there is no", gone.stderr)

    def test_ropes_are_listed(self):
        crate = self.ask("spawn", "crate", "--at", "-60,60", "--no-wake")["id"]
        buoy = self.ask("spawn", "buoy", "--at", "-60,80", "--no-wake")["id"]
        self.assertEqual(self.ask("ropes")["ropes"], [])
        mooring = self.ask("rope", "--from", f"{crate}@0.5,0,0.25", "--to", "-60,50,-2", "--length", "15")["id"]
        tow = self.ask("rope", "--from", str(crate), "--to", str(buoy), "--length", "30")["id"]
        ropes = {rope["id"]: rope for rope in self.ask("ropes")["ropes"]}
        self.assertEqual(set(ropes), {mooring, tow})
        self.assertEqual(ropes[mooring]["from"], {"body": crate, "x_m": 0.5, "y_m": 0.0, "z_m": 0.25})
        self.assertEqual(ropes[mooring]["to"], {"body": 0, "x_m": -60.0, "y_m": 50.0, "z_m": -2.0})
        self.assertEqual(ropes[tow]["length_m"], 30.0)
        self.assertAlmostEqual(ropes[tow]["apart_m"], 20.0, delta=1.5)
        told = SERVER.onesea("ropes", "--session", "tank-world").stdout.splitlines()
        self.assertIn("2 ropes", told[0])
        self.assertIn(f"{crate}@0,0,0 crate", told[2])
        self.assertIn(f"{buoy}@0,0,0 buoy", told[2])
        self.assertIn("slack", told[2])
        self.ask("rope", "--remove", str(mooring))
        self.assertEqual([rope["id"] for rope in self.ask("ropes")["ropes"]], [tow])
        self.ask("remove", str(buoy))  # and its rope
        self.assertEqual(self.ask("ropes")["ropes"], [])
        self.ask("remove", str(crate))

    def test_instruments_write_csv(self):
        buoy = self.ask("spawn", "buoy", "--at", "20,0", "--no-wake")["id"]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "readings.csv"
            reading = subprocess.Popen(
                [BIN / "onesea", "instruments", "--gauge", "3,4", "--pressure", "0,0,0,-6", "--imu", f"{buoy},0,0,0",
                 "--motion", str(buoy), "--every", "6", "--seconds", "1", "--csv", str(path), "--json", "--session",
                 "tank-world"], stdout=subprocess.PIPE, text=True, cwd=ROOT, env=SERVER.environment())
            while reading.poll() is None:  # whoever reads comes when it likes; the sea goes on until it has enough
                self.ask("step", "6")
            told = json.loads(reading.stdout.read())
            reading.stdout.close()
            self.assertEqual(reading.returncode, 0)
            with open(path, newline="") as file:
                rows = list(csv.reader(file))
        header, rows = rows[0], rows[1:]
        self.assertEqual(header[:5], ["tick", "time [s]", "skipped", "gauge 3 4 height [m]", "pressure 0 0 0 -6 [Pa]"])
        self.assertEqual(len(header), 3 + 1 + 1 + 10 + 13)
        self.assertEqual(told["readings"], len(rows))
        self.assertEqual(len(rows) + sum(int(row[2]) for row in rows) - int(rows[0][2]), 11)
        for row in rows:
            self.assertEqual(len(row), len(header))
            self.assertEqual(int(row[0]) % 6, 0)
            asked = self.ask("query", "--at", "3,4", "--time", row[1])["points"][0]["height_m"]
            self.assertAlmostEqual(float(row[3]), asked, delta=1e-5)
            self.assertAlmostEqual(float(row[4]), 1025 * 9.81 * 6, delta=1.0 * 1025 * 9.81)
            self.assertAlmostEqual(float(row[header.index(f"imu {buoy} 0 0 0 force z [m/s2]")]), 9.81, delta=2.0)
            self.assertAlmostEqual(float(row[header.index(f"motion {buoy} x [m]")]), 20.0, delta=2.0)
        self.ask("remove", str(buoy))

    def test_nonsense(self):
        for code, words, says in (
                (2, ["impulse", "1"], "--by"), (2, ["impulse", "1", "--by", "1,2"], "must be X,Y,Z"),
                (2, ["impulse", "1", "--by", "1,nan,2"], "Y of --by"), (1, ["impulse", "99", "--by", "1,0,0"], "99"),
                (2, ["obstacle"], "--corner"), (2, ["obstacle", "--corner", "0,0", "--corner", "1,1"], "three times"),
                (1, ["obstacle", "--corner", "0,0", "--corner", "4,4", "--corner", "4,0", "--corner", "0,3"], "cross"),
                (2, ["obstacle", "--remove", "0"], "--remove"),
                (2, ["region"], "--at"), (2, ["region", "--at", "0,0", "--cells", "1x2x3"], "COLUMNSxROWS"),
                (1, ["region", "--at", "0,0", "--cells", "100"], "multiple of 32"),
                (2, ["region", "--at", "0,0", "--solver", "magic"], "--solver"),
                (2, ["region", "--at", "0,0", "--rest", "nan"], "--rest"),
                (2, ["ropes", "1"], "no operand"),
                (2, ["instruments"], "--gauge"), (2, ["instruments", "--gauge", "0"], "--gauge"),
                (2, ["instruments", "--imu", "0,0,0,0"], "--imu"),
                (2, ["instruments", "--imu", "1.5,0,0,0"], "--imu"),
                (1, ["instruments", "--motion", "99"], "there is no body 99"),
                (1, ["instruments", "--gauge", "0,0", "--csv", "/no/such/folder/x.csv"], "/no/such/folder/x.csv"),
                (1, ["spawn", "submarine", "--at", "0,0"], "work-boat")):
            finished = SERVER.onesea(*words, "--session", "tank-world")
            self.assertEqual(finished.returncode, code, f"{words}: {finished.stderr}")
            self.assertEqual(len(finished.stderr.splitlines()), 1, finished.stderr)
            self.assertIn(says, finished.stderr, words)


class Refusals(unittest.TestCase):
    def refused(self, code, *words, says):
        finished = SERVER.onesea(*words)
        self.assertEqual(finished.returncode, code, f"{words}: {finished.stderr}{finished.stdout}")
        self.assertEqual(finished.stdout, "", words)
        self.assertEqual(len(finished.stderr.splitlines()), 1, finished.stderr)
        self.assertIn(says, finished.stderr, words)
        self.assertIsNone(SERVER.process.poll(), SERVER.output())

    def test_wrong_words(self):
        self.refused(2, "dance", says="unknown command 'dance'")
        self.refused(2, "query", says="--at")
        for text in ("1", "1,2,3", "nan,0", "0,inf", "1e9,0", "x,y", ""):
            self.refused(2, "query", "--at", text, says="--at")
        for text in ("nan", "inf", "4e9", "soon"):
            self.refused(2, "query", "--at", "0,0", "--time", text, says="--time")
        for text in ("-1", "nan", "12001"):
            self.refused(2, "query", "--at", "0,0", "--depth", text, says="--depth")
        self.refused(2, "query", "--at", "0,0", "--detail", "colour", says="--detail")
        for text in ("0", "-3", "36001", "1.5", "many"):
            self.refused(2, "step", text, says="N is")
        for text in ("0", "-1", "101", "nan", "fast"):
            self.refused(2, "speed", text, says="X is")
        self.refused(2, "watch", "--seconds", "0", says="--seconds")
        self.refused(2, "weather", says="--to")
        self.refused(2, "weather", "--to", "deploy/seas/fresh-breeze.textproto", "--over", "-1s", says="--over")
        self.refused(2, "create", says="create takes FILE")
        self.refused(2, "hash", "now", says="hash takes no operand")
        self.refused(2, "hash", "--sesion", "x", says="unknown option --sesion")

    def test_things_that_are_not_there(self):
        for words in (["hash"], ["query", "--at", "0,0"], ["watch"], ["hold"], ["step", "1"]):
            self.refused(1, *words, "--session", "atlantis", says="atlantis")
        self.refused(1, "delete", "atlantis", says="atlantis")
        self.refused(1, "create", "no/such/file.textproto", says="no/such/file.textproto")
        self.refused(1, "weather", "--to", "no/such/sea.textproto", says="no/such/sea.textproto")
        self.refused(1, "create", "CMakeLists.txt", says="CMakeLists.txt")

    def test_no_server(self):
        address = f"127.0.0.1:{free_port()}"
        for words in (["sessions"], ["hash"], ["watch"], ["query", "--at", "0,0", "--local"]):
            finished = subprocess.run([BIN / "onesea", *words, "--server", address], capture_output=True, text=True,
                                      timeout=30, cwd=ROOT)
            self.assertEqual(finished.returncode, 3, finished.stderr)
            self.assertEqual(len(finished.stderr.splitlines()), 1)
            self.assertIn(f"no server answers at {address}; start one with onesea-server", finished.stderr)

    def test_addresses_that_are_none(self):
        for address in ("", "127.0.0.1", "127.0.0.1:notaport", "127.0.0.1:99999999", "::::", "no such host:7310"):
            for words in (["hash"], ["sessions"]):
                finished = subprocess.run([BIN / "onesea", *words, f"--server={address}"], capture_output=True,
                                          text=True, timeout=30, cwd=ROOT)
                self.assertEqual(finished.returncode, 2, address)
                self.assertEqual(len(finished.stderr.splitlines()), 1, finished.stderr)
                self.assertIn("HOST:PORT", finished.stderr)


class Restart(unittest.TestCase):
    def test_watch_finds_a_killed_server_again(self):
        with Server() as server:
            watch = subprocess.Popen([BIN / "onesea", "watch", "--json", "--seconds", "60"], cwd=ROOT, text=True,
                                     stdout=subprocess.PIPE, env=server.environment())
            try:
                def next_reading():
                    return json.loads(watch.stdout.readline())

                before = next_reading()
                self.assertTrue(before["connected"])
                server.kill()
                lost = next_reading()
                while lost["connected"]:
                    lost = next_reading()
                self.assertGreater(lost["time_s"], before["time_s"])  # the sea goes on meanwhile
                server.start()
                after = next_reading()
                while not (after["connected"] and after["comparisons"] > lost["comparisons"]):
                    after = next_reading()
                self.assertEqual(after["connection_count"], 2)
                self.assertEqual(after["component_hash"], before["component_hash"])
                self.assertEqual(after["worst_drift_m"], 0.0)
                self.assertLess(after["time_s"], 60.0)  # of the new session, not of the old one
            finally:
                watch.kill()
                watch.wait()
                watch.stdout.close()

    def test_watch_ends_with_the_session(self):
        with Server() as server:
            watch = subprocess.Popen([BIN / "onesea", "watch", "--seconds", "60"], cwd=ROOT, text=True,
                                     stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=server.environment())
            watch.stdout.readline()
            server.ask("delete", server.ask("sessions")["sessions"][0]["name"])
            _, errors = watch.communicate(timeout=30)
            self.assertEqual(watch.returncode, 1)
            self.assertEqual(len(errors.splitlines()), 1, errors)

    def test_interrupting_watch_is_a_clean_end(self):
        watch = subprocess.Popen([BIN / "onesea", "watch"], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True, env=SERVER.environment())
        watch.stdout.readline()
        watch.send_signal(signal.SIGINT)
        _, errors = watch.communicate(timeout=10)
        self.assertEqual((watch.returncode, errors), (0, ""))


class Help(unittest.TestCase):
    def examples(self):
        listing = SERVER.onesea("--help")
        self.assertEqual(listing.returncode, 0)
        commands = re.findall(r"^  ([a-z]+)  +\S", listing.stdout.split("options:")[0], re.MULTILINE)
        self.assertGreaterEqual(len(commands), 11)
        for command in commands:
            shown = SERVER.onesea(command, "--help")
            self.assertEqual(shown.returncode, 0, shown.stderr)
            lines = shown.stdout.split("examples:\n")[1].strip().splitlines()
            self.assertTrue(lines, command)
            for line in lines:
                yield line.strip()

    def test_every_example_runs_as_printed(self):
        for line in self.examples():
            with self.subTest(line):
                words = shlex.split(line)
                self.assertEqual(words[0], "onesea")
                # With a second session beside it the default one must be named; examples show the usual case.
                only = [s["name"] for s in SERVER.ask("sessions")["sessions"] if s["name"].startswith("tank")]
                for name in only:
                    if words[1] not in ("delete", "sessions"):
                        SERVER.onesea("delete", name)
                if words[1] == "delete":
                    SERVER.onesea("create", "deploy/sessions/tank.textproto", "--session", words[2])
                if words[1] == "step":
                    SERVER.onesea("hold")
                finished = subprocess.run(line, shell=True, capture_output=True, text=True, cwd=ROOT, timeout=60,
                                          env=SERVER.environment())
                self.assertEqual(finished.returncode, 0, f"{line}: {finished.stderr}")
                self.assertTrue(finished.stdout, line)
                if words[1] in ("step", "hold"):
                    SERVER.onesea("resume")


if __name__ == "__main__":
    unittest.main()
