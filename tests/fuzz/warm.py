"""A process that has everything imported and forks itself for every file: a drawing of a broken one takes milliseconds.

Run as a program, it reads a line of JSON for each file and answers with one. No drawing is made in the process itself,
so that it has no threads when it forks.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MEMORY = 4 << 30
"""Bytes of address space for one drawing."""

SECONDS = 20


@dataclass(frozen=True)
class Result:
    """code as a shell knows it, negative for a signal; files: what is in the folder afterwards."""

    code: int
    err: str
    files: dict[str, bytes]
    seconds: float
    frames: str = ""

    def fault(self, name: str) -> str | None:
        """What is wrong with this outcome, in a word and a detail; None where it is as promised."""
        lines = self.err.splitlines()
        if self.code < 0:
            what = {-signal.SIGALRM: "hang", -signal.SIGKILL: "killed"}.get(self.code, "crash")
            return f"{what} {self.frames}"
        if "Traceback" in self.err or self.code not in (0, 2):
            return f"fault {lines[-1] if lines else self.code}"
        own = [line for line in lines if line.startswith("hlr: ")]
        said = [line for line in own if not line.startswith(("hlr: warning: ", "hlr: note: "))]
        strays = set(self.files) - {name, "out.svg", "__pycache__"}
        if strays:
            return f"strays {sorted(strays)}"
        out = self.files.get("out.svg", b"")
        if own != lines:
            return f"noise {self.err[-300:]!r}"
        if self.code == 2 and (len(said) != 1 or len(said[0]) > 600):
            return f"sentence {self.err[-300:]!r}"
        if self.code == 2 and out != b"old":
            return f"output changed {len(out)}"
        if self.code == 0 and (said or not out.startswith(b"<?xml") or not out.rstrip().endswith(b"</svg>")):
            return f"output incomplete {self.err[-200:]!r} {out[-40:]!r}"
        return None


class Warm:
    """The other side of the pipe."""

    def __init__(self) -> None:
        env = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        self._process = subprocess.Popen(
            [sys.executable, "-P", __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=env
        )

    def draw(self, name: str, data: bytes, seconds: int = SECONDS) -> Result:
        """Draw these bytes as a file of this name; "old" is the content of the output before."""
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, name).write_bytes(data)
            Path(folder, "out.svg").write_bytes(b"old")
            arguments = ["draw", name, "-o", "out.svg", "--fit", "100x100"]
            job = {"folder": folder, "arguments": arguments, "seconds": seconds}
            assert self._process.stdin is not None and self._process.stdout is not None
            self._process.stdin.write(json.dumps(job).encode() + b"\n")
            self._process.stdin.flush()
            answer = self._process.stdout.readline()
            if not answer:
                raise RuntimeError("the warm process has died")
            done: dict[str, Any] = json.loads(answer)
            files = {p.name: p.read_bytes() if p.is_file() else b"" for p in Path(folder).iterdir()}
        return Result(done["code"], done["err"], files, done["seconds"], done["frames"])

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


def _serve() -> None:
    import hlr.cli.app
    import hlr.cli.exits
    import hlr.pipeline.draw
    import hlr.source.cad.brep_file
    import hlr.source.cad.step
    import hlr.source.mesh.mesh_file
    from hlr.source.cad.occt_import import load_occt

    load_occt()
    for name in ("OCP.IGESCAFControl", "OCP.STEPCAFControl", "trimesh"):
        importlib.import_module(name)

    hlr.cli.app.command.get_command(None, "draw")  # type: ignore[arg-type]
    answers = os.dup(1)
    os.dup2(2, 1)
    for line in sys.stdin:
        job = json.loads(line)
        os.write(answers, json.dumps(_one(job)).encode() + b"\n")


def _one(job: dict[str, Any]) -> dict[str, Any]:
    with tempfile.TemporaryFile() as err, tempfile.TemporaryFile() as frames:
        started = time.monotonic()
        pid = os.fork()
        if pid == 0:
            with contextlib.suppress(BaseException):
                _work(job, err.fileno(), frames.fileno())
            os._exit(99)
        _, status = os.waitpid(pid, 0)
        took = time.monotonic() - started
        for file in (err, frames):
            file.seek(0)
        stack = [
            line.split(" in ")[-1] for line in frames.read().decode("utf-8", "replace").splitlines() if " in " in line
        ]
        text = err.read().decode("utf-8", "replace")
    code = os.waitstatus_to_exitcode(status)
    return {"code": code, "err": text, "seconds": took, "frames": " < ".join(stack[:3])}


def _work(job: dict[str, Any], err: int, frames: int) -> None:
    import faulthandler
    import resource

    os.chdir(job["folder"])
    os.dup2(os.open(os.devnull, os.O_RDWR), 0)
    os.dup2(err, 1)
    os.dup2(err, 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    faulthandler.enable(frames)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    # First the place of an endless loop, then the end.
    faulthandler.dump_traceback_later(job["seconds"] - 0.5, file=frames)
    signal.alarm(job["seconds"])
    from hlr.cli import main

    try:
        main(job["arguments"])
    except SystemExit as left:
        sys.stderr.flush()
        os._exit(left.code if isinstance(left.code, int) else 0)


if __name__ == "__main__":
    _serve()
