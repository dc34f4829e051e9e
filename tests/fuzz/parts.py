"""Random machined parts, drawn and measured: `python -m fuzz.parts FIRST LAST [--accuracy 0.02]`.

Each number is a part of CadQuery (a block, a turned part, a loft, a sweep, a shell, a plate with countersinks, two
cylinders), with fillets and cuts, and a view: along an axis, nearly along one, a standard pictorial view, or any. It is
drawn with hidden lines at 1:1 and measured as `--report` does. What breaks the promise is printed, class by class, in
accuracies; a line that bends and has no curve is one of `polylines`. An error of `outlines` may be that of the measure:
its search can end beside the outline, above all in views along an axis.
"""

from __future__ import annotations

import argparse
import math
import random
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import cadquery as cq

import hlr
from hlr.lab.measure import measured
from hlr.source import open_source
from support.at_size import AT_SIZE
from support.true_curves import bends_without_curve

CLASSES = ("edges", "outlines", "intersections", "changes", "lost")
KINDS = ("block", "turned", "loft", "sweep", "shell", "plate", "cylinders")


@dataclass(frozen=True, slots=True)
class Case:
    """A random part, and the direction from which it is seen."""

    kind: str
    shape: Any
    direction: tuple[float, float, float]


@lru_cache(maxsize=64)
def case(number: int) -> Case | None:
    """The case with this number; None where OpenCASCADE cannot make the part, or makes one that is not valid."""
    r = random.Random(number)
    kind = r.choice(KINDS)
    shape = None
    with suppress(Exception):  # OpenCASCADE's exceptions derive from Exception alone
        shape = cut(SHAPES[kind](r), r)
    if shape is None or not shape.vals() or not shape.val().isValid():
        return None
    return Case(kind, shape, direction(r))


def block(r: random.Random) -> Any:
    made = cq.Workplane().box(r.uniform(20, 50), r.uniform(20, 50), r.uniform(5, 30))
    made = filleted(made, r.choice(["|Z", ">Z", "|X", "<Y"]), r.uniform(0.5, 3))
    return made.faces(">Z").workplane().pushPoints([(r.uniform(-8, 8), r.uniform(-8, 8))]).hole(r.uniform(2, 8))


def turned(r: random.Random) -> Any:
    height, profile = 0.0, [(0.0, 0.0), (r.uniform(2, 6), 0.0)]
    for _ in range(r.randint(2, 5)):
        height += r.uniform(2, 8)
        profile.append((r.uniform(3, 20), height))
    height += r.uniform(1, 5)
    profile += [(r.uniform(2, 6), height), (0.0, height)]
    angle = r.choice([360.0, r.uniform(60, 300)])
    made = cq.Workplane("XZ").polyline(profile).close().revolve(angle, (0, 0, 0), (0, 1, 0))
    return filleted(made, None, r.uniform(0.2, 0.8))


def loft(r: random.Random) -> Any:
    base = cq.Workplane().rect(r.uniform(10, 30), r.uniform(10, 30)).workplane(offset=r.uniform(10, 30))
    return base.circle(r.uniform(3, 10)).loft(combine=True)


def sweep(r: random.Random) -> Any:
    path = cq.Workplane("XZ").spline(
        [(0, 0), (r.uniform(5, 15), r.uniform(5, 20)), (r.uniform(-10, 10), r.uniform(25, 45))]
    )
    section = cq.Workplane()
    section = section.circle(r.uniform(2, 5)) if r.random() < 0.6 else section.rect(r.uniform(2, 6), r.uniform(2, 6))
    return section.sweep(path)


def shell(r: random.Random) -> Any:
    made = cq.Workplane().box(r.uniform(20, 40), r.uniform(20, 40), r.uniform(10, 25))
    return made.edges("|Z").fillet(r.uniform(1, 4)).faces(">Z").shell(-r.uniform(0.8, 2))


def plate(r: random.Random) -> Any:
    angles = sorted(r.uniform(0, 2 * math.pi) for _ in range(r.randint(5, 9)))
    corners = [(25 * r.uniform(0.5, 1) * math.cos(a), 25 * r.uniform(0.5, 1) * math.sin(a)) for a in angles]
    made = cq.Workplane().polyline(corners).close().extrude(r.uniform(2, 8)).faces(">Z").workplane()
    return made.pushPoints([(r.uniform(-5, 5), r.uniform(-5, 5)) for _ in range(2)]).cskHole(2, 4, 82)


def cylinders(r: random.Random) -> Any:
    one = cq.Workplane().cylinder(r.uniform(10, 30), r.uniform(5, 12))
    other = cq.Workplane("XZ").cylinder(r.uniform(20, 40), r.uniform(2, 5))
    other = other.translate((r.uniform(-3, 3), 0, r.uniform(-3, 3)))
    return filleted(one.union(other) if r.random() < 0.5 else one.cut(other), None, r.uniform(0.2, 1))


SHAPES = dict(zip(KINDS, (block, turned, loft, sweep, shell, plate, cylinders), strict=True))


def filleted(made: Any, edges: str | None, radius: float) -> Any:
    """With fillets where OpenCASCADE can make them."""
    with suppress(Exception):
        return made.edges(edges).fillet(radius)
    return made


def cut(made: Any, r: random.Random) -> Any:
    """With up to two holes through it, round or square."""
    for _ in range(r.randint(0, 2)):
        tool = cq.Workplane(r.choice(["XY", "XZ", "YZ"])).center(r.uniform(-8, 8), r.uniform(-8, 8))
        tool = tool.circle(r.uniform(1, 5)) if r.random() < 0.6 else tool.rect(r.uniform(2, 8), r.uniform(2, 8))
        less = made.cut(tool.extrude(60, both=True))
        if less.val().isValid() and less.val().Volume() > 1:
            made = less
    return made


def direction(r: random.Random) -> tuple[float, float, float]:
    """Along an axis, nearly along one, a pictorial view, or any."""
    axis = [0.0, 0.0, 0.0]
    axis[r.randrange(3)] = r.choice((-1.0, 1.0))
    slightly = 10 ** r.uniform(-4, -1.5)
    x, y, z = r.choice(
        [
            axis,
            [c + r.gauss(0, slightly) for c in axis],
            [*r.choice(((1.0, 1.0), (1.0, -1.0), (1.0, 0.0), (0.0, 1.0))), r.choice((0.0, 1.0))],
            [r.gauss(0, 1) for _ in range(3)],
        ]
    )
    return x, y, z


def broken(found: Case, accuracy: float) -> dict[str, float]:
    """The classes in which the drawing of a case breaks its promise, each with its error in accuracies."""
    opened = open_source(found.shape)
    (drawing,) = hlr.draw_views(opened, [found.direction], hlr.Options(accuracy=accuracy, **AT_SIZE))
    reached = measured(opened, drawing)
    errors = {name: getattr(reached, name).worst or 0.0 for name in CLASSES}
    errors["labels"] = reached.labels.longest or 0.0
    bent = [x for x in drawing.lines if x.kind != "intersection" and bends_without_curve(x, drawing.accuracy.used)]
    if bent:
        errors["polylines"] = math.inf
    # A search that settles a thousandth beside the accuracy has settled on it.
    return {name: round(error / accuracy, 2) for name, error in errors.items() if error > 1.01 * accuracy}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--accuracy", type=float, default=0.02, help="millimetres on paper")
    given = parser.parse_args()
    cases = 0
    for number in range(given.first, given.last):
        found = case(number)
        if found is None:
            continue
        cases += 1
        errors = broken(found, given.accuracy)
        if errors:
            print(number, found.kind, found.direction, errors, flush=True)
    print(f"{cases} parts at {given.accuracy:g} mm")


if __name__ == "__main__":
    main()
