"""Filled faces cut at the sides of a window.

A face is cut at one side after another. Its loops become open chains that begin and end on the side. Their ends are
sorted along the side and joined in pairs: by the even-odd rule the side is inside the face between the first and the
second end, outside between the second and the third. So no border is drawn along the side where there is no face::

        side |   ____                side |   ____
          1 -+--/    \\                    +--/    \\
             | |  __  |       ->          | |  __  |
          2 -+--\\ \\/ /                    +--\\ \\/ /
          3 -+---\\  /                     +---\\  /
             |    \\/                      |    \\/      joined: 1 to 2, 3 to 4
          4 -+---...
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr.common.distinct import distinct
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds

Loop = list[tuple[float, float]]


def cut_fill(fill: Fill, window: Bounds) -> tuple[Fill, int]:
    """The parts of the faces inside the window, and how many faces were cut or left out."""
    sides = ((0, window.x0, 1.0), (0, window.x1, -1.0), (1, window.y0, 1.0), (1, window.y1, -1.0))
    points, starts, firsts = fill.points, fill.loops.tolist(), fill.faces.tolist()
    kept: list[tuple[int, list[Loop]]] = []
    cuts = 0
    for face in range(len(firsts) - 1):
        first, last = firsts[face], firsts[face + 1]
        own = points[starts[first] : starts[last]]
        if len(own) == 0:
            continue
        low, high = own.min(axis=0), own.max(axis=0)
        loops = [[(x, y) for x, y in points[starts[k] : starts[k + 1]].tolist()] for k in range(first, last)]
        beyond = [low[0] < window.x0, high[0] > window.x1, low[1] < window.y0, high[1] > window.y1]
        for side, crossed in zip(sides, beyond, strict=True):
            if crossed:
                loops = _half(loops, *side)
        cuts += any(beyond)
        if loops:
            kept.append((face, loops))
    if not cuts:
        return fill, 0
    return _packed(fill, kept), cuts


def _half(loops: list[Loop], axis: int, value: float, sign: float) -> list[Loop]:
    """The part of a face beyond `value` along an axis, in the direction of sign; points on it are not beyond."""
    whole: list[Loop] = []
    chains: list[Loop] = []
    for loop in loops:
        inside = [sign * (p[axis] - value) > 0.0 for p in loop]
        if all(inside):
            whole.append(loop)
        elif any(inside):
            chains += _chains(loop, inside, axis, value)
    # Chain k begins with end 2 k and ends with end 2 k + 1.
    ends = sorted(range(2 * len(chains)), key=lambda e: (chains[e // 2][-(e % 2)][1 - axis], e))
    partner = dict(zip(ends[::2], ends[1::2], strict=True)) | dict(zip(ends[1::2], ends[::2], strict=True))
    free = set(range(len(chains)))
    while free:
        joined: Loop = []
        at = 2 * min(free)
        while at // 2 in free:
            free.remove(at // 2)
            chain = chains[at // 2]
            joined += chain if at % 2 == 0 else chain[::-1]
            at = partner[at ^ 1]
        whole.append(joined)
    return whole


def _chains(loop: Loop, inside: list[bool], axis: int, value: float) -> list[Loop]:
    """The stretches of a loop that lie inside, with the points where they cross the side at both ends."""
    n = len(loop)
    out = []
    for start in range(n):
        if inside[start] and not inside[start - 1]:
            chain, i = [_passed(loop[start - 1], loop[start], axis, value)], start
            while inside[i % n]:
                chain.append(loop[i % n])
                i += 1
            chain.append(_passed(loop[(i - 1) % n], loop[i % n], axis, value))
            out.append(chain)
    return out


def _passed(a: tuple[float, float], b: tuple[float, float], axis: int, value: float) -> tuple[float, float]:
    a, b = min(a, b), max(a, b)  # the same point for both faces at the edge
    s = (value - a[axis]) / (b[axis] - a[axis])
    other = a[1 - axis] + (b[1 - axis] - a[1 - axis]) * s
    return (value, other) if axis == 0 else (other, value)


def _packed(fill: Fill, kept: list[tuple[int, list[Loop]]]) -> Fill:
    """The faces as arrays again, and of the gradients those that are still used."""
    faces = [face for face, _ in kept]
    loops = [loop for _, own in kept for loop in own]
    points = np.array([p for loop in loops for p in loop], np.float64).reshape(-1, 2)
    gradient = fill.gradient[faces]
    used = distinct(gradient[gradient >= 0])
    return replace(
        fill,
        points=points,
        loops=np.cumsum([0, *map(len, loops)]).astype(np.int32),
        faces=np.cumsum([0, *(len(own) for _, own in kept)]).astype(np.int32),
        colors=fill.colors[faces],
        gradient=np.where(gradient >= 0, np.searchsorted(used, gradient), -1).astype(np.int32),
        gradients=tuple(fill.gradients[k] for k in used.tolist()),
        part=fill.part[faces],
    )
