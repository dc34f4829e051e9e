"""The cost and benefit of exact predicates: the kernel's visibility pass with integers, f64 and f32.

All three are given the same snapped points, so the exact pass is the truth for the other two, with no tolerance.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr._kernel import Visibility
from hlr.common.types import Floats, Ints
from hlr.image.image import Image
from hlr.visibility.plan import Plan
from hlr.visibility.segments import HIDDEN, solve

KINDS = ("exact", "f64", "f32")
REPEATS = 5


@dataclass(frozen=True, slots=True)
class Rounding:
    """One kind of arithmetic on one scene.

    seconds, processor   clock and processor seconds of the visibility pass, medians
    edges                mesh edges whose visibility was decided
    failed               edges whose invisibility counts from both ends disagree; they are decided polygon by polygon
    contradictions       failed edges that contradict themselves even then; they are drawn hidden
    wrong, longest       millimetres on paper with the wrong visibility: in all, and on the worst edge
    wrong_edges          mesh edges with such pieces
    """

    arithmetic: str
    accuracy: float
    seconds: float
    processor: float
    edges: int
    failed: int
    contradictions: int
    wrong: float
    longest: float
    wrong_edges: int


def compared(image: Image, plan: Plan, projected: Floats, per_model: float, accuracy: float) -> list[Rounding]:
    """All kinds on one image, the exact one first; projected (n, 3) as the visibility pass takes it."""
    length = np.hypot(*(projected[image.edges[:, 1], :2] - projected[image.edges[:, 0], :2]).T) * per_model
    out: list[Rounding] = []
    truth: Visibility | None = None
    clocks: dict[str, list[tuple[float, float]]] = {kind: [] for kind in KINDS}
    found: dict[str, Visibility] = {}
    for _ in range(REPEATS):  # in turns, so that other load on the machine affects all kinds alike
        for kind in KINDS:
            wall, cpu = time.perf_counter(), time.process_time()
            found[kind] = solve(image, plan, projected, kind).found
            clocks[kind].append((time.perf_counter() - wall, time.process_time() - cpu))
    for kind in KINDS:
        pieces = found[kind]
        truth = truth or pieces
        wrong = _wrong(truth, pieces, length)
        counters: dict[str, Any] = pieces.counters
        out.append(
            Rounding(
                arithmetic=kind,
                accuracy=accuracy,
                seconds=median(wall for wall, _ in clocks[kind]),
                processor=median(cpu for _, cpu in clocks[kind]),
                edges=int(counters["drawn"]),
                failed=int(counters["failed_checks"]),
                contradictions=int(counters["contradictions"]),
                wrong=float(wrong.sum()),
                longest=float(wrong.max(initial=0.0)),
                wrong_edges=int((wrong > 0.0).sum()),
            )
        )
    return out


NOTHING = 255
"""State where an edge has no piece at all."""

SAME = 1e-9
"""Share of an edge: ends of pieces closer than this are the same point, rounded differently."""


def _wrong(truth: Visibility, other: Visibility, length: Floats) -> Floats:
    """(e,) millimetres of each edge that are hidden in one result and visible in the other."""
    edge, at, a, b = _merged(truth, other)
    last = np.append(edge[1:] != edge[:-1], True)
    until = np.where(last, 1.0, np.append(at[1:], 1.0))
    span = until - at
    differ = (_hidden(a) != _hidden(b)) & (span > SAME)
    return np.asarray(np.bincount(edge[differ], span[differ] * length[edge[differ]], len(length)), np.float64)


def _hidden(state: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """State to 0: drawn visible, 1: hidden, NOTHING: not drawn."""
    return np.where(state == NOTHING, NOTHING, state == HIDDEN).astype(np.uint8)


def _merged(a: Visibility, b: Visibility) -> tuple[Ints, Floats, npt.NDArray[np.uint8], npt.NDArray[np.uint8]]:
    """Where a piece of either result begins: edge and parameter, sorted; and the states of both from there on."""
    edge = np.concatenate([a.edge, b.edge])
    at = np.concatenate([a.t0, b.t0])
    source = np.repeat(np.array([0, 1]), [len(a.edge), len(b.edge)])
    state = np.concatenate([a.state, b.state])
    order = np.lexsort((source, at, edge))
    edge, at, source, state = edge[order], at[order], source[order], state[order]
    states = []
    for which in (0, 1):
        mine = np.where(source == which, np.arange(len(edge)), -1)
        latest = np.maximum.accumulate(mine)
        there = (latest >= 0) & (edge[np.maximum(latest, 0)] == edge)
        states.append(np.where(there, state[np.maximum(latest, 0)], NOTHING).astype(np.uint8))
    return edge, at, states[0], states[1]
