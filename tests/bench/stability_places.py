"""Where a disturbed drawing by hlr differs from the first: the longest stretches, each with its line.

python -m bench.stability_places MODEL --amount 1e-7 --seed 0 [--turned]
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from bench.stability_child import REACH
from bench.stability_hlr import Model
from bench.stability_measure import COVER, NEAR, STEP, covered

from hlr.drawing.drawing import Drawing
from support.ink import Ink, ink, stretches, strokes, unmatched


def places(these: Ink, others: Ink, near: float) -> Iterator[np.ndarray]:
    """Runs of neighbouring samples of one line without a match, the longest first."""
    alone = stretches(these, unmatched(these, others, near))
    yield from sorted(alone, key=lambda run: -these.length[run].sum())


def describe(drawing: Drawing, these: Ink, run: np.ndarray, under: bool) -> str:
    line = drawing.lines[these.line[run[0]]]
    what = f"{'visible' if line.visible else 'hidden'} {line.kind}"
    which = f"edge {line.edge}" if line.edge is not None else f"face {line.face}"
    start, end = (f"({x:.3f}, {y:.3f})" for x, y in these.points[[run[0], run[-1]]])
    where = f"{drawing.parts[line.part].name} (part {line.part}) {which}"
    return (
        f"{these.length[run].sum():8.3f} mm {what}, {where}, {start} to {end}{', under visible ink' if under else ''}"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=Path)
    parser.add_argument("--amount", type=float, default=1e-7)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--turned", action="store_true", help="the view instead of every vertex")
    parser.add_argument("--most", type=int, default=20, help="stretches told")
    given = parser.parse_args(arguments)
    model = Model(given.model)
    rest = model.jiggled(0.0, 0)
    moved = (model.turned if given.turned else model.jiggled)(given.amount, given.seed)
    before, after = (ink(strokes(drawing), STEP * model.accuracy) for drawing in (rest, moved))
    reach = REACH * given.amount * model.size * model.per_model
    for name, drawing, these, others in (("lost", rest, before, after), ("gained", moved, after, before)):
        print(name)
        for number, run in enumerate(places(these, others, NEAR * model.accuracy + reach)):
            if number == given.most:
                break
            hidden = not these.visible[run[0]]
            under = covered(these.points[run], before, after, COVER * model.accuracy + reach)
            print("  " + describe(drawing, these, run, hidden and bool(under.all())))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
