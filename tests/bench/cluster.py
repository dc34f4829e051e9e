"""What a batch on a Dask scheduler costs besides the drawing: `python -m bench.cluster [--kilobytes 1 1000 8000]`.

A scheduler and workers are started here, and `hlr batch --on` draws as many small models, each with a comment that
makes it as large as asked. The table has processor milliseconds a job: of the command that asks (client), of the
scheduler, and of the workers, the processes that draw included. What grows with the size is the way of the bytes.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import psutil

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
HLR = [sys.executable, "-P", "-c", "from hlr.cli import main; main()"]


def started(folder: Path, what: str, *more: str) -> subprocess.Popen[bytes]:
    """A scheduler or a worker that finds the others by a file in the folder."""
    program = [sys.executable, "-P", "-m", f"distributed.cli.dask_{what}", "--no-dashboard"]
    log = (folder / f"{what}.log").open("ab")
    command = [*program, "--scheduler-file", str(folder / "scheduler.json"), *more]
    return subprocess.Popen(command, cwd=folder, stdout=log, stderr=log)


def processor(process: psutil.Process) -> float:
    """Seconds of a process and of all that it started."""
    total = 0.0
    for each in (process, *process.children(recursive=True)):
        times = each.cpu_times()
        total += times.user + times.system
    own = process.cpu_times()
    return total + own.children_user + own.children_system


def once(folder: Path, jobs: int, size: int, address: str, cluster: list[psutil.Process]) -> list[float]:
    """Seconds by the clock; processor milliseconds a job of client, scheduler and workers."""
    models = folder / f"models{size}"
    models.mkdir()
    for number in range(jobs):
        # Each has another content, so each goes out.
        text = TETRAHEDRON.format(1 + number)
        (models / f"{number}.off").write_text(f"{text}# {number} {'x' * max(0, size - len(text) - 8)}\n")
    (models / "hlr.toml").write_text('files = "*.off"\nviews = "iso"\n')
    before = [processor(each) for each in cluster]
    begun = time.perf_counter()
    command = [*HLR, "batch", str(models), "-o", str(folder / f"out{size}"), "--on", address]
    client = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(client.pid, 0)
    seconds = time.perf_counter() - begun
    assert status == 0, status
    spent = [usage.ru_utime + usage.ru_stime, *(processor(p) - b for p, b in zip(cluster, before, strict=True))]
    return [seconds, spent[0] / jobs * 1e3, spent[1] / jobs * 1e3, sum(spent[2:]) / jobs * 1e3]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=300)
    parser.add_argument("--kilobytes", type=int, nargs="+", default=[1, 1000, 8000])
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    print(
        "| kB a model | clock, s | client, ms a job | scheduler, ms a job | workers, ms a job |\n|---|---|---|---|---|"
    )
    with TemporaryDirectory() as name:
        folder = Path(name)
        processes = [started(folder, "scheduler", "--host", "127.0.0.1", "--port", "0")]
        processes += [started(folder, "worker", "--nthreads", "1", "--no-nanny") for _ in range(given.workers)]
        try:
            while not (place := folder / "scheduler.json").exists():
                time.sleep(0.05)
            time.sleep(2.0)
            address = json.loads(place.read_text("utf-8"))["address"]
            cluster = [psutil.Process(process.pid) for process in processes]
            once(folder, 4, 0, address, cluster)  # what is loaded once is not counted
            for size in given.kilobytes:
                found = once(folder, given.jobs, size * 1000, address, cluster)
                print(f"| {size} | {found[0]:.1f} | " + " | ".join(f"{x:.1f}" for x in found[1:]) + " |", flush=True)
        finally:
            for process in processes:
                process.kill()
                process.wait()


if __name__ == "__main__":
    main()
