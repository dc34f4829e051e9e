"""What one drawing of each file takes beyond reading: `python -m bench.drawings FILE... [--views iso front]`.

Every drawing is made in a process of its own and written as SVG; nothing comes from the cache. The table has:

    read      seconds by the clock until the model is open
    seconds   by the clock, from there to the SVG on disk; then the same as processor time of all threads
    mesh, scene, outlines, visibility, lines, write    the stages of those seconds
    memory    MB: how far the largest memory of the process exceeds the largest of reading

    --options '{"scale": 1, "hidden": true}'    fields of `hlr.Options`, instead of the defaults
    --timeout 200                               processor seconds after reading at which a drawing is given up
    --json FILE                                 all figures
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from bench.table import Table

from support.programs import environment

STAGES = {
    "mesh": "tessellate",
    "scene": "scene",
    "outlines": "plan",
    "visibility": "visibility",
    "lines": "linework",
    "write": "write",
}
"""Columns of the table, and the stages of a drawing's `timings`."""
HEADINGS = ["model", "view", "scale", "read", "seconds", "processor", *STAGES, "memory", "lines", "notes"]
CLOCK = 4.0
"""Times the processor time that is allowed: where the clock shows more, a drawing is given up too."""
LIMITS = 10.0, 1000.0
"""Seconds and megabytes beyond reading: what takes more stands out."""


def _megabytes() -> float:
    """Largest memory of this process so far; Linux counts kilobytes, macOS bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024 * 1024 if sys.platform == "darwin" else 1024)


def child(path: str, view: str, options: Mapping[str, Any], target: Path, timeout: float) -> dict[str, Any]:
    """One drawing, measured in this process, which ends where it takes longer."""
    import hlr
    from hlr.source import open_source

    begun = time.perf_counter()
    source = open_source(path)
    source.bounds()
    read, memory, processor = time.perf_counter(), _megabytes(), time.process_time()
    resource.setrlimit(resource.RLIMIT_CPU, (int(processor + timeout) + 1, resource.RLIM_INFINITY))
    drawing = hlr.draw(source, view, **options)
    path_written = drawing.save(target)
    done = time.perf_counter()
    return {
        "read": read - begun,
        "seconds": done - read,
        "processor": time.process_time() - processor,
        "memory": _megabytes() - memory,
        "read_memory": memory,
        "scale": drawing.scale,
        "lines": len(drawing.lines),
        "bytes": path_written.stat().st_size,
        "stages": {**drawing.timings, "write": done - read - sum(drawing.timings[s] for s in _drawn(drawing))},
        "counters": dict(drawing.counters),
        "notes": [f"{note.code}: {note.text}" for note in drawing.notes],
    }


def _drawn(drawing: Any) -> list[str]:
    """The stages of a drawing's timings that come after reading and before writing."""
    return [stage for stage in STAGES.values() if stage in drawing.timings and stage != "write"]


def measured(path: Path, view: str, options: str, timeout: float, folder: Path) -> dict[str, Any]:
    """One drawing in a process of its own; what failed has `failure` in place of the figures."""
    command = [sys.executable, "-m", "bench.drawings", str(path), "--views", view, "--options", options]
    target = folder / f"{path.name}-{view}.svg"
    row: dict[str, Any] = {"model": path.name, "view": view}
    try:
        done = subprocess.run(
            [*command, "--timeout", str(timeout), "--child", str(target)],
            check=False,
            capture_output=True,
            text=True,
            timeout=CLOCK * timeout,
            env=environment(HLR_CACHE="off"),
        )
    except subprocess.TimeoutExpired:
        return {**row, "failure": f"not in {CLOCK * timeout:g} s by the clock"}
    if done.returncode == -signal.SIGXCPU:
        return {**row, "failure": f"not in {timeout:g} s"}
    lines = done.stdout.splitlines()
    if done.returncode or not lines:
        return {**row, "failure": (done.stderr.strip().splitlines() or ["it crashed"])[-1]}
    return row | json.loads(lines[-1])


def cells(row: Mapping[str, Any]) -> list[str]:
    """A row of the table: what exceeds its limit is bold."""
    if "failure" in row:
        return [row["model"], row["view"], *["-"] * (len(HEADINGS) - 3), f"**{row['failure']}**"]
    stages = row["stages"]
    most, memory = LIMITS
    return [
        row["model"],
        row["view"],
        f"{row['scale']:.4g}",
        f"{row['read']:.1f}",
        _bold(f"{row['seconds']:.1f}", row["seconds"] > most),
        f"{row['processor']:.1f}",
        *(f"{stages.get(stage, 0.0):.2f}" for stage in STAGES.values()),
        _bold(f"{row['memory']:.0f}", row["memory"] > memory),
        f"{row['lines']:,}",
        ", ".join(sorted({note.partition(":")[0] for note in row["notes"]})),
    ]


def _bold(text: str, really: bool) -> str:
    return f"**{text}**" if really else text


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--views", nargs="+", default=["iso", "front"])
    parser.add_argument("--options", default="{}")
    parser.add_argument("--timeout", type=float, default=200.0)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--keep", type=Path, help="a folder for the drawings")
    parser.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args(arguments)
    if given.child:
        options = {key: tuple(x) if isinstance(x, list) else x for key, x in json.loads(given.options).items()}
        print(json.dumps(child(str(given.files[0]), given.views[0], options, given.child, given.timeout)))
        return 0
    results = []
    print(f"load average {os.getloadavg()[0]:.1f}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for path in given.files:
            for view in given.views:
                row = measured(path, view, given.options, given.timeout, given.keep or Path(folder))
                results.append(row)
                print(" | ".join(cells(row)), flush=True)
                if given.json:
                    given.json.write_text(json.dumps(results, indent=1))
    print(f"\n{Table(HEADINGS, [cells(row) for row in results], results)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
