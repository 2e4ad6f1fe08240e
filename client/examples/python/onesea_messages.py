"""Generates the Python code of Onesea's messages from the plain proto files and imports it."""

import importlib
import pathlib
import shutil
import subprocess
import sys
import tempfile

PROTO_ROOT = pathlib.Path(__file__).resolve().parents[3] / "proto"


def load(*names):
    """The modules onesea.v1.NAME, generated into a folder that is gone afterwards; a real program does it once."""
    protos = sorted(str(path) for path in PROTO_ROOT.glob("onesea/v1/*.proto"))
    plugin = shutil.which("grpc_python_plugin")
    if shutil.which("protoc") and plugin:
        command = ["protoc", f"--plugin=protoc-gen-grpc_python={plugin}"]
    else:
        command = [sys.executable, "-m", "grpc_tools.protoc"]
    with tempfile.TemporaryDirectory() as folder:
        outputs = [f"-I{PROTO_ROOT}", f"--python_out={folder}", f"--grpc_python_out={folder}"]
        subprocess.run(command + outputs + protos, check=True)
        sys.path.insert(0, folder)
        try:
            return [importlib.import_module("onesea.v1." + name) for name in names]
        finally:
            sys.path.remove(folder)
