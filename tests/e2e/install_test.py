"""find_package(onesea) from an install tree: a program outside the tree builds against it and floats on a live sea.

    install_test.py            the build tree's own libraries
    install_test.py no-fftw    a client-only build without FFTW, whose programs closed source may contain
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from onesea_process import ROOT, Server

CALM = ROOT / "deploy/sessions/calm-swell.textproto"

BUILD = pathlib.Path(os.environ["ONESEA_BUILD"])


def run(*words, **options):
    finished = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if finished.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{finished.stdout}{finished.stderr}")
    return finished.stdout


def build_without_fftw():
    """Kept in the build tree, so that the next run compiles only what changed."""
    build = BUILD / "no-fftw"
    run("cmake", "-G", "Ninja", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DONESEA_WITH_FFTW=OFF",
        "-DONESEA_WITH_TESTS=OFF", "-DONESEA_WITH_VIEWER=OFF")
    run("cmake", "--build", build, "--target", "onesea_client")
    return build


def float_a_buoy(program):
    with Server() as server:
        output = run(program, server.address, timeout=30)
    heights = re.findall(r"floats at ([+-]\d+\.\d+) m", output)
    assert len(heights) == 10 and len(set(heights)) > 1, output
    print(output)


def drive_a_boat(program):
    with Server(CALM) as server:
        running = subprocess.Popen([program, server.address], stdout=subprocess.PIPE, text=True)
        try:
            time.sleep(5.0)
            (body,) = server.ask("bodies")["bodies"]
            output, _ = running.communicate(timeout=60)
        finally:
            running.kill()
        assert running.returncode == 0, running.returncode
        assert body["name"] == "example" and body["driver"] == "a game", body
        shown = re.findall(r"bow at \((-?[\d.]+), .*: the water is at ([+-][\d.]+) m, .* astern ([+-][\d.]+) m of wake",
                           output)
        assert len(shown) >= 15, output
        places, wakes = [float(x) for x, *_ in shown], [abs(float(wake)) for *_, wake in shown]
        assert places[-1] - places[0] > 10.0, shown  # it drove
        assert places[0] - 5.0 < body["x_m"] < places[-1], (places, body)  # on its way
        assert max(wakes) > 0.02, shown
        for _ in range(100):  # it cleans up behind itself
            if not server.ask("bodies")["bodies"]:
                break
            time.sleep(0.05)
        assert server.ask("bodies")["bodies"] == []
        print(output)
    dead = subprocess.run([program, "127.0.0.1:1"], capture_output=True, text=True, timeout=30)
    assert dead.returncode == 1 and "127.0.0.1:1" in dead.stderr, dead


def main():
    without_fftw = sys.argv[1:] == ["no-fftw"]
    built = build_without_fftw() if without_fftw else BUILD
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder) / "prefix"
        example = pathlib.Path(folder) / "example"
        run("cmake", "--install", built, "--component", "client", "--prefix", prefix)
        run("cmake", "-G", "Ninja", "-S", ROOT / "client/examples/cpp", "-B", example, f"-DCMAKE_PREFIX_PATH={prefix}",
            "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", example)
        if without_fftw:
            linked = run("ldd", example / "onesea_boat") + run("nm", example / "onesea_boat")
            assert "libfftw" not in linked and "fftwf_" not in linked, "FFTW is linked"
        float_a_buoy(example / "onesea_example")
        drive_a_boat(example / "onesea_boat")


if __name__ == "__main__":
    main()
