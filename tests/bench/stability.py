"""How much of a drawing changes when its model is moved a little: a table and plots, other programs beside it.

    python -m bench.stability MODEL...
    python -m bench.stability MODEL... --drawers hlr,hlr-turned --seeds 5
    python -m bench.stability --plot      only draw the plots anew, from stability.csv

Every coordinate of every vertex of the tessellation is moved by a random amount of at most 1e-9 to 1e-3 of the model's
size, the model is drawn again, and ink is counted that is in one drawing and not in the other.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from bench import stability_plot
from bench.stability_child import DRAWERS

from support.markdown import markdown
from support.programs import environment

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "stability"
AMOUNTS = np.logspace(-9, -3, 13)
COLUMNS = (
    "model",
    "drawer",
    "amount",
    "seed",
    "visible",
    "hidden",
    "lost_visible",
    "gained_visible",
    "lost_hidden",
    "gained_hidden",
    "under",
    "accuracy",
    "seconds",
    "failure",
)
Row = dict[str, Any]


class Child:
    """A drawer in a process of its own; it may crash, and it is ended when a drawing takes too long."""

    def __init__(self, drawer: str, path: Path, limit: int) -> None:
        self._limit = limit
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "bench.stability_child", drawer, str(path), str(limit)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment(),
        )

    def answer(self, ask: str = "") -> Row:
        """The next line of the child as a record; a record with "failure" if the child wrote none."""
        process = self._process
        assert process.stdin is not None and process.stdout is not None and process.stderr is not None
        try:
            process.stdin.write(ask)
            process.stdin.flush()
            line = process.stdout.readline()
        except BrokenPipeError:
            line = ""
        if line:
            found: Row = json.loads(line)
            return found
        code = process.wait()
        if code == -signal.SIGXCPU:
            return {"failure": f"no drawing in {self._limit} s"}
        return {"failure": (process.stderr.read().strip().splitlines() or [f"ended with {code}"])[-1][:80]}

    def end(self) -> None:
        self._process.kill()
        self._process.communicate()


def measured(path: Path, drawer: str, seeds: int, limit: int, budget: float) -> Iterator[Row]:
    """Seed by seed, as many as fit the budget; a failure ends the drawer and is a row of its own.

    limit, budget: seconds of computing for one drawing, and after which no further seed is tried.
    """
    who = {"model": path.name, "drawer": drawer}
    child = Child(drawer, path, limit)
    try:
        rest = child.answer()
        if "failure" in rest:
            yield who | rest
            return
        about = {key: rest[key] for key in ("visible", "hidden", "accuracy")}
        spent = 0.0
        for seed in range(seeds):
            for amount in AMOUNTS.tolist():
                if seed and spent > budget:
                    return
                found = child.answer(f"{amount} {seed}\n")
                yield who | about | {"amount": amount, "seed": seed} | found
                if "failure" in found:
                    return
                spent += found["seconds"]
    finally:
        child.end()


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path)
    parser.add_argument("-o", "--out", type=Path, default=EXAMPLES)
    parser.add_argument("--drawers", type=lambda text: text.split(","), default=list(DRAWERS), help=", ".join(DRAWERS))
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--limit", type=int, default=120, help="seconds of computing for one drawing")
    parser.add_argument("--budget", type=float, default=60.0, help="seconds after which no further seed is tried")
    parser.add_argument("--plot", action="store_true", help="draw the plots from the table that is there")
    given = parser.parse_args(arguments)
    given.out.mkdir(parents=True, exist_ok=True)
    table = given.out / "stability.csv"
    rows: list[Row]
    if not given.plot:
        rows = []
        for path in given.models:
            for drawer in given.drawers:
                found = list(measured(path, drawer, given.seeds, given.limit, given.budget))
                rows += found
                end = found[-1].get("failure", "")
                seconds = sum(row.get("seconds", 0.0) for row in found)
                print(
                    f"{path.name} {drawer}: {len(found)} drawings, {seconds:.0f} s {end}", file=sys.stderr, flush=True
                )
                write(table, rows)
    rows = read(table)
    stability_plot.plot(rows, given.out)
    print(summary(rows))
    return 0


def summary(rows: Sequence[Row]) -> str:
    """Medians of some columns of the plots, visible ink."""
    shown = AMOUNTS[[0, 2, 4, 6, 8, 10]]
    lines = []
    for model, drawer in dict.fromkeys((row["model"], row["drawer"]) for row in rows):
        own = [row for row in rows if (row["model"], row["drawer"]) == (model, drawer)]
        curve = {f"{amount:.0e}": values for amount, values in stability_plot.shares(own, "visible").items()}
        cells = [_percent(curve.get(f"{amount:.0e}")) for amount in shown]
        lines.append([model, DRAWERS[drawer], *(cells if curve else [own[-1]["failure"], *[""] * (len(shown) - 1)])])
    return markdown(["model", "drawn by", *(f"{amount:.0e}" for amount in shown)], lines)


def _percent(shares: Sequence[float] | None) -> str:
    if not shares:
        return "-"
    middle = 100.0 * float(np.median(shares))
    return f"{middle:.2g} %" if middle else "0"


def write(path: Path, rows: Sequence[Row]) -> None:
    """A row per drawing; lengths in millimetres on paper. The table appears whole or not at all."""
    draft = path.with_suffix(".tmp")
    with draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items() if k in COLUMNS})
    os.replace(draft, path)


def read(path: Path) -> list[Row]:
    text = {"model", "drawer", "failure"}
    with path.open(newline="", encoding="utf-8") as file:
        return [
            {key: value if key in text else float(value) for key, value in row.items() if value}
            for row in csv.DictReader(file)
        ]


if __name__ == "__main__":
    raise SystemExit(main())
