"""Benchmarks against the peers, side by side in one run, each measurement in its own process.

    python tests/bench/run.py                        all but the slow ones, five repeats, medians
    python tests/bench/run.py --scenes plate20,asm4000 --repeat 3 --json out.json
    python tests/bench/run.py --slow --exact         asm16000 by PolyAlgo too (minutes), and the exact algorithm
    python tests/bench/run.py --part svg FILE.step   shape in memory to SVG, with files of your own

1. hidden-line removal of one isometric view, hidden lines on, against PolyAlgo on the same triangulation
2. shape in memory to SVG on disk, tessellation included, against CadQuery's export
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1]))

from peers.report import markdown

KERNEL_SCENES = ("plate20", "asm1000", "asm4000", "asm16000", "tori250")
SVG_SCENES = ("plate20", "asm4000")
WITHOUT_PEER = {"tori250"}
SLOW = {("asm16000", "poly"), ("asm16000", "exact"), ("asm4000", "exact")}
Result = dict[str, Any]


def measured(scene: str, who: str, repeat: int, timeout: float) -> Result:
    """A failure is a result too: the table says so instead of lacking a row."""
    script = Path(__file__).with_name("measure.py")
    command = [sys.executable, str(script), scene, who, f"--repeat={repeat}"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return {"scene": scene, "who": who, "failure": f"> {timeout:.0f} s"}
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        return {"scene": scene, "who": who, "failure": lines[-1][:60]}
    result: Result = json.loads(done.stdout.splitlines()[-1])
    print(f"{scene} {who}: {result['seconds']:.4g} s", file=sys.stderr, flush=True)
    return result


def seconds(result: Result | None) -> str:
    if result is None:
        return "-"
    return f"{result['seconds']:.3f}" if "seconds" in result else result["failure"]


def ratio(peer: Result | None, own: Result) -> str:
    if peer is None or "seconds" not in peer or "seconds" not in own:
        return "-"
    return f"{peer['seconds'] / own['seconds']:.1f} x"


def memory(result: Result | None) -> str:
    return f"{result['peak_mb']:.0f}" if result and "peak_mb" in result else "-"


def kernel_table(scenes: Sequence[str], given: argparse.Namespace, results: list[Result]) -> str:
    peers = ["poly", *(["exact"] if given.exact else [])]
    headings = [
        "scene",
        "triangles",
        "kernel s",
        *[f"{peer} s" for peer in peers],
        *[f"{peer} / kernel" for peer in peers],
    ]
    headings += ["stage of hlr.draw s", "poly / stage", "kernel MB", "poly MB"]
    rows = []
    for scene in scenes:
        own = measured(scene, "kernel", given.repeat, given.timeout)
        stage = measured(scene, "draw", given.repeat, given.timeout)
        found = {}
        for peer in peers:
            slow = (scene, peer) in SLOW
            if scene not in WITHOUT_PEER and (given.slow or not slow):
                found[peer] = measured(scene, peer, 1 if slow else given.repeat, given.timeout)
        results += [own, stage, *found.values()]
        rows.append(
            [
                Path(scene).name,
                str(own.get("triangles", "-")),
                seconds(own),
                *[seconds(found.get(peer)) for peer in peers],
                *[ratio(found.get(peer), own) for peer in peers],
                seconds(stage),
                ratio(found.get("poly"), stage),
                memory(own),
                memory(found.get("poly")),
            ]
        )
    return markdown(headings, rows)


def svg_table(scenes: Sequence[str], given: argparse.Namespace, results: list[Result]) -> str:
    headings = ["shape", "hlr s", "CadQuery s", "CadQuery / hlr", "hlr kB", "CadQuery kB", "CadQuery / hlr"]
    headings += ["hlr lines", "CadQuery lines", "hlr MB", "CadQuery MB"]
    rows = []
    for scene in scenes:
        own = measured(scene, "hlr-svg", given.repeat, given.timeout)
        peer = measured(scene, "cadquery-svg", min(given.repeat, 3), given.timeout)
        results += [own, peer]
        both = (own, peer)
        size = [f"{each['bytes'] / 1000:.0f}" if "bytes" in each else "-" for each in both]
        size.append(f"{peer['bytes'] / own['bytes']:.1f} x" if all("bytes" in each for each in both) else "-")
        lines = [str(each.get("lines", "-")) for each in both]
        times = [seconds(own), seconds(peer), ratio(peer, own)]
        rows.append([Path(scene).name, *times, *size, *lines, memory(own), memory(peer)])
    return markdown(headings, rows)


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="STEP or BREP files for the second table")
    parser.add_argument("--part", choices=("kernel", "svg", "both"), default="both")
    parser.add_argument("--scenes", type=lambda text: text.split(","), help="only these scenes")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--slow", action="store_true", help="peers that take minutes too, once each")
    parser.add_argument("--exact", action="store_true", help="OpenCASCADE's exact algorithm beside the polygonal one")
    parser.add_argument("--timeout", type=float, default=1200.0, help="seconds for one measurement")
    parser.add_argument("--json", type=Path, help="all figures")
    given = parser.parse_args(arguments)
    results: list[Result] = []
    print(f"{platform.platform()}, {os.cpu_count()} cores, Python {platform.python_version()}, medians\n")
    if given.part in {"kernel", "both"}:
        print(kernel_table(given.scenes or KERNEL_SCENES, given, results) + "\n", flush=True)
    if given.part in {"svg", "both"}:
        chosen = [scene for scene in given.scenes or SVG_SCENES if scene in SVG_SCENES]
        print(svg_table([*chosen, *given.files], given, results), flush=True)
    if given.json:
        given.json.write_text(json.dumps(results, indent=1))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
