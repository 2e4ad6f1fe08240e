"""Starts the real programs for end-to-end tests. Standard library only."""

import json
import os
import pathlib
import random
import socket
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("ONESEA_BIN", ROOT / "build" / "release" / "bin"))
DEFAULT_SESSION = ROOT / "deploy" / "sessions" / "storm-41010.textproto"


def free_port():
    """A port that nobody listens on, below the range from which outgoing connections are numbered."""
    while True:
        port = random.randint(20000, 31000)
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError:
                continue


class Server:
    """An onesea-server on a free loopback port; `with Server() as server: server.onesea("sessions")`."""

    def __init__(self, *sessions, port=None):
        self.sessions = sessions or (DEFAULT_SESSION,)
        self.port = port or free_port()
        self.address = f"127.0.0.1:{self.port}"
        self.log = tempfile.TemporaryFile(mode="w+")
        self.process = None

    def start(self):
        words = [str(BIN / "onesea-server"), f"--listen={self.address}"]
        words += [f"--session={session}" for session in self.sessions]
        self.process = subprocess.Popen(words, stdout=self.log, stderr=subprocess.STDOUT, cwd=ROOT)
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            if self.process.poll() is not None:
                raise AssertionError(f"the server ended with {self.process.returncode}:\n{self.output()}")
            if self.onesea("sessions").returncode == 0:
                return self
            time.sleep(0.05)
        raise AssertionError(f"the server does not answer:\n{self.output()}")

    def output(self):
        self.log.seek(0)
        return self.log.read()

    def kill(self):
        """As a crash would: no farewell."""
        self.process.kill()
        self.process.wait()

    def stop(self):
        if self.process is not None and self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()

    def __enter__(self):
        return self.start()

    def __exit__(self, *_):
        self.stop()
        self.log.close()

    def environment(self):
        return dict(os.environ, ONESEA_SERVER=self.address, PATH=f"{BIN}:{os.environ['PATH']}")

    def onesea(self, *words, timeout=30):
        """Runs one command against this server; answers the finished process with its text."""
        return subprocess.run([str(BIN / "onesea"), *words], capture_output=True, text=True, cwd=ROOT,
                              timeout=timeout, env=self.environment())

    def ask(self, *words):
        """Runs one command with --json and answers the object that it printed."""
        finished = self.onesea(*words, "--json")
        if finished.returncode != 0:
            raise AssertionError(f"onesea {' '.join(words)}: exit code {finished.returncode}: {finished.stderr}")
        return json.loads(finished.stdout)
