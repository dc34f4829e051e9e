"""The expected ink of a hard case, computed from first principles or kept as a picture.

Ink is what a drawing puts on paper: straight pieces, visible and hidden ones separate, before the drawing is moved to
its origin. Two inks are compared by points sampled along each: every point of one must have ink of the other, of the
same visibility, within a tolerance, and the other way round. So only the place of lines matters, not how they are cut
or chained. Distances do not show that a line is drawn twice; `doubled` does.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

import hlr
from hlr import Drawing, Line
from support.measures import distances, drawn_twice, placed
from support.visibility.oracle import LARGEST, states_either_side

Floats = npt.NDArray[np.float64]

SVG = "{http://www.w3.org/2000/svg}"
NUMBER = r"-?\d*\.?\d+"
FINE = 64
COUNTS = {"q": 4, "t": 2, "c": 6, "s": 4, "a": 7}
META = "{urn:hlr:drawing:1}"

UNDER = 3.0
"""Accuracies: a hidden line this close to a visible one lies under its ink and need not be drawn."""
MOST_TOLD = 5
LIFT = 32


@dataclass(frozen=True)
class Ink:
    """visible, hidden: (n, 2, 2) straight pieces in millimetres on paper, (P.right, P.up) * scale."""

    visible: Floats
    hidden: Floats

    def lengths(self) -> tuple[float, float]:
        """Millimetres of visible and of hidden ink."""
        return ink_length(self.visible), ink_length(self.hidden)


def pieces(walks: Iterable[Floats]) -> Floats:
    """(n, 2, 2) straight pieces of polylines (k, 2)."""
    return np.concatenate([np.zeros((0, 2, 2)), *[np.stack([w[:-1], w[1:]], axis=1) for w in walks]])


def ink_length(ink: Floats) -> float:
    """Millimetres of all pieces together."""
    return float(np.hypot(*(ink[:, 1] - ink[:, 0]).T).sum())


def ink(drawing: Drawing, without: Sequence[str] = ()) -> Ink:
    """The ink of a drawing; line classes in `without` are left out."""
    chosen = [line for line in drawing.lines if line.kind not in without]
    return Ink(
        pieces(placed(drawing, line) for line in chosen if line.visible),
        pieces(placed(drawing, line) for line in chosen if not line.visible),
    )


def on_paper(drawing: Drawing, points: npt.ArrayLike) -> Floats:
    """Project points of the model (n, 3) as the exchange format says, but without the move to the drawing's origin."""
    view, p = drawing.view, np.asarray(points, dtype=np.float64).reshape(-1, 3)
    factor = np.full(len(p), drawing.unit * drawing.scale)
    if view.eye is not None:
        p = p - view.eye
        factor = factor * view.distance / -(p @ np.asarray(view.direction))
    return np.stack([p @ np.asarray(view.right), p @ np.asarray(view.up)], axis=1) * factor[:, None]


def lines_of_sight(drawing: Drawing, points: npt.ArrayLike) -> Floats:
    """(n, 3) place on paper and projective depth, which grows away from the viewer; lines and planes stay straight."""
    view, p = drawing.view, np.asarray(points, dtype=np.float64).reshape(-1, 3)
    ahead = -(p - (view.eye or (0.0, 0.0, 0.0))) @ np.asarray(view.direction)
    factor = drawing.unit * drawing.scale
    depth = ahead * factor if view.eye is None else -(view.distance**2) / ahead * factor
    return np.concatenate([on_paper(drawing, p), depth[:, None]], axis=1)


Edge3 = tuple[npt.ArrayLike, npt.ArrayLike]


def expect(drawing: Drawing, visible: Iterable[Edge3], hidden: Iterable[Edge3] = ()) -> Ink:
    """Ink from pieces of edges whose ends were computed by hand, in the model."""
    flat = [
        np.array([on_paper(drawing, np.asarray(e, float)) for e in edges]).reshape(-1, 2, 2)
        for edges in (visible, hidden)
    ]
    return Ink(*flat)


def by_oracle(
    drawing: Drawing, points: npt.ArrayLike, triangles: npt.ArrayLike, edges: Iterable[tuple[int, int]]
) -> Ink:
    """Ink from the exact rational oracle: `edges` (pairs of point numbers) against all triangles, one by one.

    The points are rounded to 2^-21 of the drawing's size first: far below any accuracy. Where oblique faces coincide
    that is enough for one to lie before the other, so the edges are moved LIFT of these steps toward the viewer.
    """
    where = lines_of_sight(drawing, points)
    centre = (where.min(axis=0) + where.max(axis=0)) / 2
    size = np.abs(where - centre).max()
    grid = np.round((where - centre) * (0.99 * LARGEST / size)).astype(int)
    corners = [(x, y, z) for x, y, z in grid.tolist()]
    faces = [(corners[i], corners[j], corners[k]) for i, j, k in np.asarray(triangles).tolist()]
    found: dict[bool, list[Floats]] = {False: [], True: []}
    for i, j in edges:
        if corners[i][:2] == corners[j][:2]:
            continue
        a, b = where[i, :2], where[j, :2]
        p, q = ((x, y, z - LIFT) for x, y, z in (corners[i], corners[j]))
        for t0, t1, is_hidden in states_either_side((p, q), faces):
            found[is_hidden].append(np.stack([a + (b - a) * float(Fraction(t)) for t in (t0, t1)]))
    return Ink(pieces(found[False]), pieces(found[True]))


def samples(ink: Floats, step: float) -> Floats:
    """(m, 2) points along the pieces, at most `step` apart; ends of pieces too."""
    count = np.ceil(np.hypot(*(ink[:, 1] - ink[:, 0]).T) / step).astype(int) + 1
    t = np.concatenate([np.zeros(0), *[np.linspace(0.0, 1.0, n) for n in count]])
    a, b = (np.repeat(ink[:, k], count, axis=0) for k in (0, 1))
    return a + (b - a) * t[:, None]


def _missing(what: str, points: Floats, off: Floats, tolerance: float) -> Iterator[str]:
    for n in np.flatnonzero(off > tolerance)[:MOST_TOLD]:
        x, y = points[n]
        yield f"{what} at ({x:.6g}, {y:.6g}): nearest {off[n]:.3g} mm away, {tolerance:.3g} allowed"


def differences(
    expected: Ink,
    drawn: Ink,
    tolerance: float,
    step: float | None = None,
    ends: float = 0.0,
    judged: Ink | None = None,
) -> list[str]:
    """Descriptions of the places where two inks differ; empty if they agree.

    tolerance and step (between samples; four tolerances) in millimetres on paper. What is expected hidden but lies
    within UNDER tolerances of visible ink may be missing. ends: so much further may expected ink be from the drawn one,
    where pieces shorter than the accuracy were left out. judged: the drawn ink that must be expected, if not all of it.
    """
    told: list[str] = []
    step = step or 4.0 * tolerance
    seen, unseen = samples(expected.visible, step), samples(expected.hidden, step)
    told += _missing("visible ink is missing", seen, distances(seen, drawn.visible), tolerance + ends)
    covered = distances(unseen, drawn.visible) <= UNDER * tolerance
    unseen = unseen[~covered]
    told += _missing("hidden ink is missing", unseen, distances(unseen, drawn.hidden), tolerance + ends)
    judged = judged or drawn
    seen, unseen = samples(judged.visible, step), samples(judged.hidden, step)
    told += _missing("visible ink that should not be there", seen, distances(seen, expected.visible), tolerance)
    told += _missing("hidden ink that should not be there", unseen, distances(unseen, expected.hidden), tolerance)
    return told


def agrees(
    drawing: Drawing, expected: Ink, *, without: Sequence[str] = (), step: float | None = None, ends: float = 0.0
) -> None:
    """Assert that a drawing is what is expected, within its own accuracy, and draws nothing twice.

    Kinds in `without` need not be expected, but may stand for what is.
    """
    assert expected.visible.size + expected.hidden.size, "nothing is expected: the comparison would be empty"
    used = drawing.accuracy.used
    told = differences(expected, ink(drawing), used, step, ends, judged=ink(drawing, without))
    assert not told, "\n".join(told)
    assert doubled(drawing) == 0.0


def doubled(drawing: Drawing) -> float:
    """Millimetres of paper along which a line lies on another."""
    return drawn_twice(drawing)


def of_kind(drawing: Drawing, kind: str, visible: bool | None = None) -> list[Line]:
    """The lines of one kind."""
    return [x for x in drawing.lines if x.kind == kind and visible in (None, x.visible)]


def read_picture(path: Path) -> Ink:
    """The ink of an SVG that hlr wrote, in the frame of `Ink`. Shares no code with the writer."""
    root = ElementTree.parse(path).getroot()
    meta = root.find(f".//{META}drawing")
    assert meta is not None
    origin = np.array([float(v) for v in meta.attrib["origin"].split()])
    found: dict[str, Floats] = {}
    for visibility in ("visible", "hidden"):
        group = root.find(f"{SVG}g[@id='{visibility}']")
        paths = [] if group is None else [p.attrib["d"] for p in group.iter(f"{SVG}path")]
        walks = [walk for d in paths for walk in _walks(d)]
        if group is not None:
            walks += [_round(shape) for name in ("circle", "ellipse") for shape in group.iter(SVG + name)]
        found[visibility] = pieces(walk * [1, -1] + origin for walk in walks)
    return Ink(**found)


def _walks(d: str) -> Iterator[Floats]:
    """Polylines of a path of M, l, h, v, z, q, t, c, s and a, as the writer uses them; curves as FINE chords each."""
    for run in re.findall(r"M[^M]*", d):
        walk: list[tuple[float, float]] = []
        # The last control point before an end, from it: what t and s go on from.
        arm = np.zeros(2)
        for command, text in re.findall(r"([Mlhvzqtcsa])([^Mlhvzqtcsa]*)", run):
            numbers = _arc_numbers(text) if command == "a" else [float(n) for n in re.findall(NUMBER, text)]
            if command == "z":
                walk.append(walk[0])
            elif command in COUNTS:
                for k in range(0, len(numbers), COUNTS[command]):
                    start, given = np.array(walk[-1]), numbers[k : k + COUNTS[command]]
                    if command == "a":
                        curve = _arc(start, given)
                    else:
                        others = np.reshape(given, (-1, 2))
                        if command in "ts":
                            others = np.concatenate([[-arm], others])
                        arm = others[-2] - others[-1]
                        curve = _bezier(start, others)
                    walk += [(x, y) for x, y in curve[1:].tolist()]
            elif command in "hv":
                for n in numbers:
                    x, y = walk[-1]
                    walk.append((x + n, y) if command == "h" else (x, y + n))
            else:
                for dx, dy in zip(numbers[::2], numbers[1::2], strict=True):
                    x, y = walk[-1] if walk else (0.0, 0.0)
                    walk.append((x + dx, y + dy))
        yield np.array(walk)


def _arc_numbers(text: str) -> list[float]:
    """Radii, turn, two flags of one digit that need nothing between them, and the end; any number of arcs."""
    flags = r"[\s,]*([01])[\s,]*([01])[\s,]*"
    three = rf"({NUMBER})[\s,]*({NUMBER})(?:[\s,]+|(?=-))({NUMBER})"
    found = re.findall(rf"[\s,]*{three}{flags}({NUMBER})[\s,]*({NUMBER})", text)
    return [float(n) for arc in found for n in arc]


def _bezier(start: Floats, others: Floats) -> Floats:
    p = np.concatenate([[start], start + others])[:, None]
    t = np.linspace(0.0, 1.0, FINE + 1)[:, None]
    while len(p) > 1:
        p = p[:-1] + (p[1:] - p[:-1]) * t
    return np.asarray(p[0])


def _arc(start: Floats, given: Sequence[float]) -> Floats:
    """Points of an elliptical arc, by the formulas of the SVG specification (implementation notes, B.2.4)."""
    rx, ry, turn, large, sweep, dx, dy = given
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    # In the frame of the axes, in half axes, with the middle of the chord as origin.
    half = np.array([-(c * dx + s * dy) / (2 * rx), (s * dx - c * dy) / (2 * ry)])
    size = float(np.hypot(*half))
    rx, ry, half = rx * max(1.0, size), ry * max(1.0, size), half / max(1.0, size)
    far = np.sqrt(max(0.0, 1.0 / float(half @ half) - 1.0)) * (-1.0 if large == sweep else 1.0)
    centre = far * np.array([half[1], -half[0]])
    first, last = (np.arctan2(*(end - centre)[::-1]) for end in (half, -half))
    angle = (last - first) % (2 * np.pi) - (0.0 if sweep else 2 * np.pi)
    t = first + angle * np.linspace(0.0, 1.0, FINE + 1)
    x, y = rx * (np.cos(t) + centre[0]), ry * (np.sin(t) + centre[1])
    return start + np.array([dx, dy]) / 2 + np.stack([c * x - s * y, s * x + c * y], axis=1)


def _round(shape: ElementTree.Element) -> Floats:
    """Points of a circle or an ellipse."""
    given = shape.attrib
    rx, ry = (float(given.get(name, given.get("r", 0))) for name in ("rx", "ry"))
    t = np.linspace(0.0, 2 * np.pi, 4 * FINE + 1)
    points = np.stack([float(given["cx"]) + rx * np.cos(t), float(given["cy"]) + ry * np.sin(t)], axis=1)
    turned = re.fullmatch(
        rf"rotate\(({NUMBER})[ ,]+({NUMBER})[ ,]+({NUMBER})\)", given.get("transform", "rotate(0 0 0)")
    )
    assert turned, given
    angle, *pivot = (float(n) for n in turned.groups())
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.asarray((points - pivot) @ np.array([[c, s], [-s, c]]) + pivot)


def wrong_by_rays(drawing: Drawing, points: npt.ArrayLike, triangles: npt.ArrayLike) -> tuple[int, int]:
    """(judged, wrong) samples of the drawing's lines, by rays cast against the model's own triangles.

    Give points and triangles in the coordinates of the model that was drawn.
    """
    from hlr.drawing.saving import render
    from support.referee import exchange, judge, reference

    verdict = judge.judge(
        exchange.parse(render(drawing, "json")), judge.RayCaster(reference.from_arrays(points, triangles))
    )
    return len(verdict.samples.line), verdict.wrong


def defects(source: object) -> list[str]:
    """All defects of all parts, as `hlr info` words them."""
    return [text for part in hlr.info(source).parts for text in part.defects]


def straight_lines(drawing: Drawing, visible: bool) -> list[tuple[Floats, Floats]]:
    """The straight pieces of one visibility as pairs of points in the model."""
    return [(a, b) for line in drawing.lines if line.visible == visible for a, b in pairwise(line.points3)]


def covers(drawing: Drawing, lines: Iterable[Edge3], step: float | None = None) -> None:
    """Assert that these edges, hidden or not, are all that is drawn; with `wrong_by_rays` this is the whole truth."""
    drawn = ink(drawing)
    both = Ink(np.concatenate([drawn.visible, drawn.hidden]), np.zeros((0, 2, 2)))
    told = differences(expect(drawing, lines), both, drawing.accuracy.used, step)
    assert not told, "\n".join(told)
