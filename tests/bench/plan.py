"""What the plan saves: drawings that do only what the scene calls for, beside drawings that do everything.

    python -m bench.plan FOLDER                  every model of a folder, and the bench scenes
    python -m bench.plan FOLDER --repeat 5 --no-hidden --view front
    python -m bench.plan --scenes asm1000,plate20 --json out.json

Each model is read and drawn in turns, both ways, so that what else the machine does hits both alike; medians
of processor time, all threads together, for on a shared machine the wall clock measures the others. Reading is
left out. Both drawings must be the same, byte for byte.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from statistics import median
from typing import Any

from bench.scenes import SCENES

import hlr
import hlr.common.clock
import hlr.pipeline.finish
import hlr.pipeline.session
import hlr.request.effect
from hlr.drawing.saving import render
from hlr.request.effect import PLAN, SCENE, everything_on
from hlr.source import open_source
from hlr.tables.readers import endings
from support.markdown import markdown

for module in (hlr.common.clock, hlr.pipeline.finish, hlr.pipeline.session, hlr.request.effect):
    vars(module)["perf_counter"] = time.process_time  # the stages' stopwatch

STAGES = ("tessellate", "scene", "plan", "visibility", "linework")


def compared(thing: Any, options: hlr.Options, view: str, repeat: int) -> dict[str, Any]:
    """Seconds per stage both ways, what was off, and what deciding took."""
    clocks: dict[bool, list[dict[str, float]]] = {False: [], True: []}
    svg = {}
    for _ in range(repeat + 1):  # the first of each loads what is loaded late
        for forced in (False, True):
            with everything_on() if forced else nullcontext():
                # Opened anew: a source keeps what it has looked up once.
                (drawing,) = hlr.draw_views(open_source(thing), [view], options)
            clocks[forced].append(dict(drawing.timings))
            svg[forced] = render(drawing, "svg")
            if not forced:
                planned = drawing
    if svg[False] != svg[True]:
        raise AssertionError("the two drawings differ")
    seconds = {way: {s: median(c[s] for c in clocks[way][1:]) for s in STAGES} for way in clocks}
    took = next(d.seconds for d in planned.plan if d.name == PLAN) or 0.0
    return {
        "plan": seconds[False],
        "all": seconds[True],
        "share": took / sum(seconds[False].values()),
        "off": [d.name for d in planned.plan if d.origin == SCENE and not d.on],
        "triangles": int(planned.counters["triangles"]),
    }


def row(name: str, found: dict[str, Any]) -> list[str]:
    """Of the table: milliseconds with the plan, and how many times more all would take."""
    plan, every = found["plan"], found["all"]

    def cell(stages: Sequence[str]) -> str:
        one, other = (sum(way[s] for s in stages) for way in (plan, every))
        return f"{1000 * one:.0f} ({other / one:.2f})" if one > 0.0 else "-"

    cells = [cell(["scene"]), cell(["plan"]), cell(["visibility"]), cell(["linework"]), cell(STAGES[1:]), cell(STAGES)]
    return [name, f"{found['triangles']:,}", *cells, f"{100 * found['share']:.1f} %"]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path)
    parser.add_argument(
        "--scenes", type=lambda text: text.split(",") if text else [], default=["plate20", "asm1000", "asm4000"]
    )
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--view", default="iso")
    parser.add_argument("--no-hidden", action="store_true")
    parser.add_argument("--most", type=float, default=6.0, help="megabytes of a file; larger ones are left out")
    parser.add_argument("--json", type=Path, help="all figures")
    given = parser.parse_args(arguments)
    things: list[tuple[str, Any]] = [(name, SCENES[name]) for name in given.scenes]
    if given.folder:
        files = sorted(p for p in given.folder.iterdir() if p.suffix.lower() in endings())
        things += [(p.name, lambda p=p: p) for p in files if p.stat().st_size < given.most * 1e6]
    headings = ["model", "triangles", "scene", "plan", "visibility", "linework", "after meshing", "whole", "deciding"]
    rows, results = [], {}
    for name, make in things:
        size = {"scale": 1.0} if name in SCENES else {"fit": (277, 190)}
        options = hlr.Options(hidden=not given.no_hidden, smooth=False, **size)
        try:
            found = compared(make(), options, given.view, given.repeat)
        except hlr.HlrError as error:
            print(f"{name}: {error}", file=sys.stderr)
            continue
        rows.append(row(name, found))
        results[name] = found
        print(" | ".join(rows[-1]), file=sys.stderr, flush=True)
    print("Milliseconds with the plan, and in brackets how many times more with everything on.\n")
    print(markdown(headings, rows))
    if given.json:
        given.json.write_text(json.dumps(results, indent=1))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
