"""The Python example that steers a boat along a square, against a live server with a swell."""

import re
import subprocess

from examples_test import python_words
from onesea_process import ROOT, Server

PROGRAM = "client/examples/python/steer_square.py"


def run(server_address, *options):
    interpreter = python_words()[0][0]
    return subprocess.run([interpreter, str(ROOT / PROGRAM), server_address, *options], capture_output=True, text=True,
                          timeout=170)


def main():
    with Server(ROOT / "deploy" / "sessions" / "calm-swell.textproto") as server:
        finished = run(server.address, "--side", "30", "--lock-step")
        print(finished.stdout, finished.stderr)
        assert finished.returncode == 0, finished.returncode
        rms, most = map(float, re.search(r"track error: ([\d.]+) m rms, ([\d.]+) m at most", finished.stdout).groups())
        # A boat of 5 m in a swell of 1.2 m that turns within some lengths; one that sails off or in circles is far beyond.
        assert 0.0 < rms < 3.5 and most < 9.0, (rms, most)
        assert "square of 30 m done" in finished.stdout
        assert server.ask("bodies")["bodies"] == []  # it cleans up behind itself
        assert server.ask("sessions")["sessions"][0]["pace"] == "real time"

        gave_up = run(server.address, "--side", "500", "--lock-step", "--seconds", "2")
        assert gave_up.returncode == 1 and "gave up on side 1" in gave_up.stderr, gave_up
        unknown = run(server.address, "--preset", "submarine")
        assert unknown.returncode == 1 and "work-boat" in unknown.stderr, unknown
        assert "Traceback" not in unknown.stderr, unknown.stderr
    dead = run("127.0.0.1:1")
    assert dead.returncode == 1 and "127.0.0.1:1" in dead.stderr and "Traceback" not in dead.stderr, dead


if __name__ == "__main__":
    main()
