"""Draws one model by one program, in a process of its own, because other programs may crash or never end.

Writes a JSON object per line: first the drawing at rest, then one for every (amount, seed) it reads.
"""

from __future__ import annotations

import json
import resource
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from bench.stability_hlr import Model
from bench.stability_measure import STEP, change

from support.ink import Ink, Stroke, ink, strokes

Drawer = Callable[[float, int], list[Stroke]]

DRAWERS = {
    "hlr": "hlr, every vertex moved",
    "poly": "OpenCASCADE PolyAlgo, every vertex moved",
    "hlr-turned": "hlr, view turned",
    "exact-turned": "OpenCASCADE exact, view turned",
}
REACH = 2.0
"""How far on paper a disturbed point may go at most, in amounts of the model's size: all three coordinates together."""


def drawer(name: str, model: Model, path: Path) -> Drawer:
    if name == "hlr":
        return lambda amount, seed: strokes(model.jiggled(amount, seed))
    if name == "hlr-turned":
        return lambda amount, seed: strokes(model.turned(amount, seed))
    from bench.stability_occt import Exact, Poly

    return Poly(model, path) if name == "poly" else Exact(model, path)


class Measurement:
    """One program's drawing of the undisturbed model, and its changes when the model is disturbed."""

    def __init__(self, model: Model, draw: Drawer) -> None:
        self._model, self._draw = model, draw
        self.rest = self._ink(0.0, 0)

    def _ink(self, amount: float, seed: int) -> Ink:
        return ink(self._draw(amount, seed), STEP * self._model.accuracy)

    def __call__(self, amount: float, seed: int) -> dict[str, Any]:
        start = time.process_time()
        after = self._ink(amount, seed)
        seconds = time.process_time() - start
        moved = REACH * amount * self._model.size * self._model.per_model
        found = change(self.rest, after, self._model.accuracy, moved)
        return {"amount": amount, "seed": seed, "seconds": seconds, **vars(found)}


def allow(seconds: int) -> None:
    """Limit this process to so many seconds of processor time from now; clock time would depend on other load."""
    hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
    resource.setrlimit(resource.RLIMIT_CPU, (int(time.process_time()) + seconds + 1, hard))


def main(arguments: Sequence[str]) -> int:
    name, path, limit = arguments[0], Path(arguments[1]), int(arguments[2])
    model = Model(path)
    allow(limit)
    measure = Measurement(model, drawer(name, model, path))
    about = {
        "visible": measure.rest.total(True),
        "hidden": measure.rest.total(False),
        "accuracy": model.accuracy / model.per_model / model.size,
        "triangles": sum(len(part.triangles) for part in model.parts),
    }
    print(json.dumps(about), flush=True)
    for line in sys.stdin:
        amount, seed = line.split()
        allow(limit)
        print(json.dumps(measure(float(amount), int(seed))), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
