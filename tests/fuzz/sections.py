"""Random pairs of bodies that pass through each other: `python -m fuzz.sections FIRST LAST [--accuracy 0.05]`.

Most do so at small angles. OpenCASCADE's section of both bodies is exact. Each of its points needs an intersection line
of hlr or an edge beside it, except where the bodies go less deep into each other than a contact; and each intersection
line needs the section beside it. What is drawn is to be within the accuracy of the section. A pair that lacks more of
its section, or is farther off, is printed with the mean depth of the common volume: below two and a half accuracies its
deepest place may well be a contact.
"""

from __future__ import annotations

import argparse
import random
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cadquery as cq
import numpy as np
import numpy.typing as npt
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Section

import hlr
from support.met import intersections

Floats = npt.NDArray[np.float64]

BESIDE = 10.0
"""Accuracies: surfaces that cross at a small angle do so this much farther aside than their chord error is."""
SPACING = 0.2
"""Millimetres between points of a section."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two bodies, where they cross, and the direction from which they are seen.

    section  (n, 2, 3) short chords of it; depth: the mean depth of what both have in common, mm
    """

    bodies: tuple[Any, Any]
    section: Floats
    depth: float
    direction: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Compared:
    """Millimetres of the section, of it without a line, and of intersection lines beside no section.

    off: how far points of drawn intersection lines with a section beside them are from it, at most, mm
    """

    section: float
    missing: float
    wrong: float
    off: float


def box(r: random.Random) -> Any:
    return cq.Workplane().box(r.uniform(10, 40), r.uniform(10, 40), r.uniform(3, 15))


def rounded_box(r: random.Random) -> Any:
    made = cq.Workplane().box(r.uniform(20, 40), r.uniform(20, 40), r.uniform(8, 15))
    return made.edges().fillet(r.uniform(0.5, 3))


def cylinder(r: random.Random) -> Any:
    return cq.Workplane().cylinder(r.uniform(10, 40), r.uniform(4, 15))


def cone(r: random.Random) -> Any:
    return cq.Workplane(cq.Solid.makeCone(r.uniform(8, 15), r.uniform(5, 8), r.uniform(10, 30)))


def loft(r: random.Random) -> Any:
    base = cq.Workplane().rect(r.uniform(10, 30), r.uniform(10, 30)).workplane(offset=r.uniform(10, 30))
    return base.circle(r.uniform(3, 10)).loft(combine=True)


def elliptic(r: random.Random) -> Any:
    return cq.Workplane().ellipse(r.uniform(8, 20), r.uniform(4, 8)).extrude(r.uniform(10, 30))


BODIES = (box, rounded_box, cylinder, cone, loft, elliptic)


@lru_cache(maxsize=64)
def pair(number: int) -> Pair | None:
    """The pair with this number; None where the bodies do not cross, or OpenCASCADE finds no common volume."""
    r = random.Random(number)
    one, other = (r.choice(BODIES)(r).val() for _ in range(2))
    other = other.moved(cq.Location(cq.Vector(), cq.Vector(*r.choice([(1, 0, 0), (0, 1, 0)])), r.choice([0, 90, 180])))
    axis = r.choice([(1, 0, 0), (0, 1, 0), (0, 0, 1), tuple(r.gauss(0, 1) for _ in range(3))])
    other = other.moved(cq.Location(cq.Vector(), cq.Vector(*axis), r.choice([0, r.uniform(-8, 8), r.uniform(-2, 2)])))
    # Their boxes overlap a little along one axis.
    depth = r.choice([r.uniform(0.05, 1), r.uniform(1, 4)])
    high, low = one.BoundingBox(), other.BoundingBox()
    k = r.randrange(3)
    shift = [r.uniform(-6, 6) for _ in range(3)]
    shift[k] = (high.xmax, high.ymax, high.zmax)[k] - (low.xmin, low.ymin, low.zmin)[k] - depth
    other = other.moved(cq.Location(cq.Vector(*shift)))
    direction = (r.gauss(0, 1), r.gauss(0, 1), r.gauss(0, 1))
    common = cq.Shape.cast(BRepAlgoAPI_Common(one.wrapped, other.wrapped).Shape())
    edges = cq.Shape.cast(BRepAlgoAPI_Section(one.wrapped, other.wrapped).Shape()).Edges()
    if not edges or common.Area() < 1e-6:
        return None
    section = np.concatenate([chords(edge) for edge in edges])
    return Pair((one, other), section, 2 * common.Volume() / common.Area(), direction)


def chords(edge: Any) -> Floats:
    """(n, 2, 3) along an edge."""
    count = max(3, int(edge.Length() / SPACING))
    points = np.array([p.toTuple() for p in edge.positions([k / count for k in range(count + 1)])])
    return np.stack([points[:-1], points[1:]], axis=1)


def compared(of: Pair, accuracy: float) -> Compared:
    """The intersection lines of a pair beside its section."""
    found: list[Floats] = [np.zeros((0, 2, 3))]
    with intersections(found):
        drawing = hlr.draw(
            list(of.bodies), of.direction, hidden=True, scale=1.0, accuracy=accuracy, smooth=True, details=True
        )
    met = np.concatenate(found)
    edges = [np.stack([x.points3[:-1], x.points3[1:]], axis=1) for x in drawing.lines if x.kind != "intersection"]
    near = BESIDE * accuracy
    without = distances(of.section.mean(axis=1), np.concatenate([*edges, met])) > near
    aside = distances(met.mean(axis=1), of.section) > near
    length, of_met = (np.linalg.norm(x[:, 1] - x[:, 0], axis=1) for x in (of.section, met))
    drawn = [x.points3 for x in drawing.lines if x.kind == "intersection"]
    off = distances(np.concatenate([np.zeros((0, 3)), *drawn]), of.section)
    return Compared(
        float(length.sum()),
        float(length[without].sum()),
        float(of_met[aside].sum()),
        float(off[off <= near].max(initial=0.0)),
    )


def distances(points: Floats, segments: Floats) -> Floats:
    """(n,) from each point (n, 3) to the nearest segment (m, 2, 3)."""
    start, way = segments[:, 0], segments[:, 1] - segments[:, 0]
    square = np.maximum((way**2).sum(axis=1), 1e-30)
    out = np.full(len(points), np.inf)
    for k in range(0, len(points) if len(segments) else 0, 200):
        rest = points[k : k + 200, None] - start
        share = np.clip((rest * way).sum(axis=2) / square, 0, 1)
        out[k : k + 200] = np.linalg.norm(rest - way * share[..., None], axis=2).min(axis=1)
    return out


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--accuracy", type=float, default=0.05, help="millimetres on paper (default 0.05)")
    given = parser.parse_args()
    tried = 0
    for number in range(given.first, given.last):
        of = pair(number)
        if of is None:
            continue
        tried += 1
        told = compared(of, given.accuracy)
        if max(told.missing, told.wrong) > 1.0 or told.off > given.accuracy:
            print(
                f"{number}: {told.missing:.1f} of {told.section:.1f} mm missing, {told.wrong:.1f} mm wrong, "
                f"{told.off:.3f} mm off, mean depth {of.depth:.2f} mm",
                flush=True,
            )
    print(f"{tried} pairs cross")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
