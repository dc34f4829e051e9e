"""Kills runs of `hlr batch` at random moments, every other one while it writes, and looks at what they leave.

    python tests/batch/kill_runs.py --kills 100

After each kill every file that has its name must be whole, no worker may be left, and every third time a second run of
the same batch, which nobody kills, must draw all. The cache stays from kill to kill; at the end one more run must give
the same files as one that was never disturbed.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil

from hlr.cache.entry import unpacked
from hlr.cache.store import DRAWINGS, Store

MODELS = 12
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"


class Scene:
    """A folder of small models, and runs of a batch over them."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.out, self.cache = folder, folder / "out", folder / "cache"
        for number in range(MODELS):
            (folder / f"{number}.off").write_text(TETRAHEDRON.format(number + 1))
        self.change(0)
        self.start().wait()
        self.whole = self.files()
        assert len(self.whole) == 4 * MODELS

    def change(self, number: int) -> None:
        """Change an option that changes no byte of the drawings: all have to be drawn again."""
        (self.folder / "hlr.toml").write_text(
            f'output = "out"\nformats = ["svg", "pdf"]\nviews = ["top", "iso"]\ncrease = {20 + number / 100}\n'
        )

    def start(self) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-P", "-m", "hlr", "batch", "-q"]
        return subprocess.Popen(command, cwd=self.folder, env={**os.environ, "HLR_CACHE": str(self.cache)})

    def files(self) -> dict[str, bytes]:
        """All drawings that have their names."""
        found = [path for path in self.out.glob("*.*") if path.suffix in (".svg", ".pdf") and path.name[0] != "."]
        return {path.name: path.read_bytes() for path in found}

    def kill(self, number: int, rng: random.Random, longest: float) -> int:
        """Kill a run, and check what it leaves. Returns how many files it had written."""
        self.change(number)
        shutil.rmtree(self.out, ignore_errors=True)
        process = self.start()
        other = self.start() if number % 3 == 0 else None
        if number % 2:
            time.sleep(rng.uniform(0.0, longest))
        else:  # while files are written
            least = rng.randrange(1, 4 * MODELS)
            while process.poll() is None and len(list(self.out.glob("*.*"))) < least:
                time.sleep(0.001)
        workers = children(process.pid)
        process.kill()
        process.wait()
        if other is not None:
            assert other.wait() == 0
            assert self.files() == self.whole
        psutil.wait_procs(workers, timeout=10)
        assert not [worker for worker in workers if worker.is_running()], "a worker is left"
        files = self.files()
        assert files.items() <= self.whole.items(), "a file is not whole"
        return len(files)

    def finish(self) -> None:
        """The next run goes on, and every entry of the cache is whole."""
        assert self.start().wait() == 0
        assert self.files() == self.whole
        entries = Store(self.cache, 10**9, DRAWINGS).entries()
        assert len(entries) >= MODELS
        for entry in entries:
            unpacked(entry.path.stem, entry.path.read_bytes())


def children(pid: int) -> list[psutil.Process]:
    """All processes that a process has started, directly or through others."""
    try:
        return psutil.Process(pid).children(recursive=True)
    except psutil.Error:
        return []


def killed(folder: Path, kills: int, seed: int = 0) -> list[int]:
    """Kill so many runs. Returns how many files each had written."""
    scene, rng = Scene(folder), random.Random(seed)
    scene.change(1)
    started = time.monotonic()
    scene.start().wait()
    longest = 1.2 * (time.monotonic() - started)
    written = [scene.kill(number, rng, longest) for number in range(2, kills + 2)]
    scene.finish()
    return written


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        written = killed(Path(folder), wanted.kills, wanted.seed)
    none, all_, some = written.count(0), written.count(4 * MODELS), len(written)
    print(f"{len(written)} runs were killed: {none} before the first file, {all_} after the last, ", end="")
    print(f"{some - none - all_} between; no file was half-written, no worker left, and the last run drew all")


if __name__ == "__main__":
    main()
