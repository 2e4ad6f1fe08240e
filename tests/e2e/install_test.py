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

from onesea_process import ROOT, Server

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
        program = example / "onesea_example"
        if without_fftw:
            linked = run("ldd", program) + run("nm", program)
            assert "libfftw" not in linked and "fftwf_" not in linked, "FFTW is linked"
        with Server() as server:
            output = run(program, server.address, timeout=30)
        heights = re.findall(r"floats at ([+-]\d+\.\d+) m", output)
        assert len(heights) == 10 and len(set(heights)) > 1, output
        print(output)


if __name__ == "__main__":
    main()
