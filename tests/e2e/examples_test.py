"""The Python and Node examples against a live server.    examples_test.py python|node"""

import pathlib
import re
import shutil
import subprocess
import sys

from onesea_process import ROOT, Server

SKIPPED = 77  # as tests/e2e/CMakeLists.txt tells ctest


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def python_words():
    try:
        import grpc  # noqa: F401
        import google.protobuf  # noqa: F401
    except ImportError as error:
        skip(f"{error}; install python3-grpcio and python3-protobuf")
    if not shutil.which("protoc") or not shutil.which("grpc_python_plugin"):
        skip("install protobuf-compiler and protobuf-compiler-grpc")
    return [sys.executable, str(ROOT / "client/examples/python/onesea_example.py")], ["--seconds", "2.5"]


def node_words():
    folder = ROOT / "client/examples/node"
    if not shutil.which("node"):
        skip("install nodejs")
    if not (folder / "node_modules/@grpc/grpc-js").is_dir():
        skip(f"run: npm ci --prefix {folder.relative_to(ROOT)}")
    return ["node", str(folder / "onesea_example.js")], ["2.5"]


def main():
    program, options = {"python": python_words, "node": node_words}[sys.argv[1]]()
    with Server() as server:
        finished = subprocess.run([*program, server.address, *options], capture_output=True, text=True, timeout=60)
        print(finished.stdout, finished.stderr)
        assert finished.returncode == 0, finished.returncode
        session = server.ask("sessions")["sessions"][0]
        assert f"session {session['name']}:" in finished.stdout
        assert f"component hash {session['component_hash']}" in finished.stdout
        # 30 frames a second; without acknowledgements the server stops after 8.
        frames = int(re.search(r"(\d+) frames in", finished.stdout).group(1))
        assert frames > 20, frames
        shown = re.findall(r"height at \((\d+), 0\) at ([\d.]+) s: ([+-]?[\d.]+) m", finished.stdout)
        assert len(shown) == 4, shown
        # The command gives the same heights for that time.
        for x_m, time_s, height_m in shown:
            point = server.ask("query", "--at", f"{x_m},0", "--time", time_s)["points"][0]
            assert abs(point["height_m"] - float(height_m)) < 0.01, (point, height_m)
        dead = subprocess.run([*program, "127.0.0.1:1", *options], capture_output=True, text=True, timeout=60)
        assert dead.returncode == 1 and "127.0.0.1:1" in dead.stderr, dead
        assert "Traceback" not in dead.stderr, dead.stderr


if __name__ == "__main__":
    main()
