"""Tables of pairs: hlr and a peer measured back to back in one process, memory in processes of their own."""

from __future__ import annotations

import json
import subprocess
import sys
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bench.table import Table, geometric_mean

from support.programs import environment

WITHOUT_PEER = {"tori250"}
SLOW = {("asm16000", "poly"), ("asm16000", "exact"), ("asm4000", "exact")}
Result = dict[str, Any]


def measured(scene: str, who: Sequence[str], given: Namespace, repeat: int) -> list[Result]:
    """Measure programs in turns, in one process. A failure is a result too, and has its row in the table."""
    command = [
        sys.executable,
        "-P",
        "-m",
        "bench.measure",
        scene,
        ",".join(who),
        f"--repeat={repeat}",
        f"--budget={given.budget}",
    ]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=given.timeout, check=False, env=environment()
        )
    except subprocess.TimeoutExpired:
        return _failed(scene, who, f"> {given.timeout:.0f} s")
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        return _failed(scene, who, lines[-1][:60])
    results: list[Result] = json.loads(done.stdout.splitlines()[-1])
    for result in results:
        print(f"{scene} {result['who']}: {result['seconds']:.4g} s", file=sys.stderr, flush=True)
    return results


def _failed(scene: str, who: Sequence[str], failure: str) -> list[Result]:
    return [{"scene": scene, "who": each, "failure": failure} for each in who]


def together(scene: str, who: Sequence[str], given: Namespace, slow: bool = False) -> list[Result]:
    """Times of all programs in turns, or one by one if any fails; then the memory of each in its own process."""
    repeat = 1 if slow else given.repeat
    results = measured(scene, who, given, repeat)
    if len(who) > 1 and any("failure" in result for result in results):
        results = [result for each in who for result in measured(scene, [each], given, repeat)]
    if given.memory:
        base = measured(scene, ["memory"], given, 1)[0].get("peak_mb", 0.0)
        for result in results:
            if "seconds" in result:
                alone = measured(scene, [result["who"]], given, 1)[0]
                result |= {"peak_mb": alone.get("peak_mb"), "own_mb": alone.get("peak_mb", base) - base}
    return results


def seconds(result: Result | None) -> str:
    if result is None:
        return "-"
    return f"{result['seconds']:.3g}" if "seconds" in result else str(result["failure"])


def ratio(peer: Result | None, own: Result) -> float | None:
    """How many times as long the peer takes; None where one of the two is not known."""
    if peer is None or "seconds" not in peer or "seconds" not in own:
        return None
    return float(peer["seconds"] / own["seconds"])


def times(value: float | None) -> str:
    """A ratio as text; ratios below one are marked."""
    if value is None:
        return "-"
    return f"{value:.1f} x" if value >= 1.0 else f"**{value:.2f} x**"


def memory(result: Result | None) -> str:
    return f"{result['peak_mb']:.0f} MB" if result and result.get("peak_mb") else "-"


def won(ratios: list[float | None]) -> str:
    """The line below a table of pairs."""
    known = [value for value in ratios if value is not None]
    lost = sum(value < 1.0 for value in known)
    return f"Geometric mean of {len(known)} ratios: {geometric_mean(known):.2f}; lost: {lost}."


def kernel_table(scenes: Sequence[str], given: Namespace) -> Table:
    """The kernel and OpenCASCADE's algorithms on the same triangles, and the stage of hlr.draw."""
    peers = ["poly", *(["exact"] if given.exact else [])]
    headings = ["scene", "triangles", "kernel s", *[f"{peer} s" for peer in peers]]
    headings += [*[f"{peer} / kernel" for peer in peers], "stage of hlr.draw s", "poly / stage", "kernel", "poly"]
    rows, results, ratios = [], [], []
    for scene in scenes:
        chosen = [p for p in peers if scene not in WITHOUT_PEER and (given.slow or (scene, p) not in SLOW)]
        slow = any((scene, peer) in SLOW for peer in chosen)
        own, *others = together(scene, ["kernel", *chosen], given, slow)
        (stage,) = measured(scene, ["draw"], given, given.repeat)
        results += [own, *others, stage]
        found = {other["who"]: other for other in others}
        ratios.append(ratio(found.get("poly"), own))
        row = [Path(scene).name, f"{own.get('triangles', 0):,}", seconds(own)]
        row += [seconds(found.get(peer)) for peer in peers]
        row += [times(ratio(found.get(peer), own)) for peer in peers]
        row += [seconds(stage), times(ratio(found.get("poly"), stage)), memory(own), memory(found.get("poly"))]
        rows.append(row)
    return Table(headings, rows, results, [won(ratios)])


def svg_table(scenes: Sequence[str], given: Namespace, own: str, other: str, peer: str) -> Table:
    """From the shape in memory to the SVG on disk, triangulation included. own, other: of `measure.WHO`."""
    headings = ["shape", f"{peer} s", "hlr s", "ratio", "runs", peer, "hlr", f"lines by {peer}", "by hlr"]
    headings += [f"memory of {peer}", "of hlr"]
    rows, results, ratios = [], [], []
    for scene in scenes:
        ours, theirs = together(scene, [own, other], given)
        results += [ours, theirs]
        ratios.append(ratio(theirs, ours))
        both = (theirs, ours)
        sizes = [f"{each['bytes'] / 1000:,.0f} kB" if "bytes" in each else "-" for each in both]
        lines = [f"{each['lines']:,}" if "lines" in each else "-" for each in both]
        row = [Path(scene).name, seconds(theirs), seconds(ours), times(ratios[-1]), str(len(ours.get("all", [])))]
        rows.append([*row, *sizes, *lines, memory(theirs), memory(ours)])
    return Table(headings, rows, results, [won(ratios)])
