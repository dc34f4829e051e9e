"""Line classes: why a line is drawn. Each class is one row of a table, which every stage reads.

How wide its lines are, and in what colour, the style says (`hlr.request.style`).

A new class is a new row. Meshes, the scene and the kernel carry its number. The kernel treats all classes alike, but
for the few that it creates or looks for itself (`kernel/linework/src/lines/drawn.rs`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Literal

from hlr.tables.entry import Table

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

Kind = Literal["sharp", "smooth", "seam", "outline", "boundary", "intersection", "hatch"]
"""The name of a line's class, for type checkers: `Line.kind`, "class" in JSON, the class of a group in SVG."""


class EdgeClass(IntEnum):
    """Numbers of the classes that stages make themselves, as the kernel has them."""

    SHARP = 0
    SMOOTH = 1
    SEAM = 2
    BOUNDARY = 3
    OUTLINE = 4
    INTERSECTION = 5
    HATCH = 6


INTERIOR = 255
"""In place of a class: the edge of a triangle inside a face, of which no line is drawn."""


@dataclass(frozen=True, slots=True)
class LineClass:
    """A row of the table.

    number           as meshes, the scene and the kernel carry it; numbers run from 0 without a gap
    name             what drawings and files call it
    title            of its lines, for people
    rank             of lines that coincide in the image the one of the lower eight (rank // 8) is drawn, of those the
                     nearer, at one depth the one of the lower rank; at most 246. Intersection lines along which one
                     surface is nowhere deep in the other have 8 more
    place            lines are drawn in rising order of it, so that the wide ones lie on top
    border           a face ends there, at another or at nothing
    tangent          the surface goes on there without a fold, so that its image may turn over
    option           the option that asks for such lines (`hlr.request.options.Options`); None: they are always drawn
    by_default       whether they are drawn where the option is not given; None: in pictorial views only
    help             of that option on the command line
    counter          of such lines among a drawing's counters, and with it a row in the table of effects; None: neither
    occt             which result of OpenCASCADE's HLRBRep such lines belong to: sharp, smooth, sewn or outline
    """

    number: int
    name: Kind
    title: str
    rank: int
    place: int
    border: bool = False
    tangent: bool = False
    option: str | None = None
    by_default: bool | None = True
    help: str = ""
    counter: str | None = None
    occt: str = "sharp"

    def drawn(self, options: object) -> bool:
        """Whether lines of this class are drawn; options: `hlr.request.options.Options`."""
        return self.option is None or bool(getattr(options, self.option))


LINE_CLASSES: Table[LineClass] = Table(
    (row.name, row)
    for row in (
        LineClass(EdgeClass.SHARP, "sharp", "sharp edges", rank=0, place=4, border=True),
        LineClass(
            EdgeClass.SMOOTH,
            "smooth",
            "smooth edges",
            rank=16,
            place=0,
            border=True,
            tangent=True,
            option="smooth",
            by_default=None,
            help="Tangent edges, thin. Default: in pictorial views only.",
            counter="smooth_lines",
            occt="smooth",
        ),
        LineClass(
            EdgeClass.SEAM,
            "seam",
            "seams",
            rank=32,
            place=1,
            tangent=True,
            option="seam",
            by_default=False,
            help="Also the seams of closed surfaces.",
            counter="seam_lines",
            occt="sewn",
        ),
        LineClass(EdgeClass.BOUNDARY, "boundary", "borders", rank=1, place=2, border=True),
        LineClass(EdgeClass.OUTLINE, "outline", "outlines", rank=3, place=5, occt="outline"),
        LineClass(
            EdgeClass.INTERSECTION,
            "intersection",
            "intersection lines",
            rank=2,
            place=3,
            option="intersections",
            help="Lines where surfaces pass through each other. Default: on.",
            counter="intersection_lines",
        ),
        LineClass(EdgeClass.HATCH, "hatch", "hatch lines", rank=48, place=-1),
    )
)
"""All classes, by name."""


@LINE_CLASSES.derived
def by_number() -> tuple[LineClass, ...]:
    """All classes; each stands at its number."""
    return tuple(sorted(LINE_CLASSES.values(), key=lambda row: row.number))


@LINE_CLASSES.derived
def in_drawing_order() -> tuple[int, ...]:
    """The numbers of all classes, in the order in which their lines are drawn."""
    return tuple(row.number for row in sorted(LINE_CLASSES.values(), key=lambda row: row.place))


@LINE_CLASSES.derived
def names() -> tuple[Kind, ...]:
    """The names of all classes; each stands at its number."""
    return tuple(row.name for row in by_number())


@LINE_CLASSES.derived
def optional() -> tuple[LineClass, ...]:
    """Classes that an option asks for, in the order of their numbers."""
    return tuple(row for row in by_number() if row.option is not None)


@LINE_CLASSES.derived
def counted() -> tuple[LineClass, ...]:
    """Classes whose lines are counted, in the order of their numbers."""
    return tuple(row for row in by_number() if row.counter is not None)


@LINE_CLASSES.derived
def ranks() -> npt.NDArray[np.uint8]:
    """The rank of each class, at its number; not to be changed."""
    import numpy as np

    found = np.array([row.rank for row in by_number()], np.uint8)
    found.flags.writeable = False
    return found


def where(fits: Callable[[LineClass], bool], interior: bool = False) -> npt.NDArray[np.bool_]:
    """(256,) by the class of an edge, whether its row fits; interior: what holds for INTERIOR."""
    import numpy as np

    out = np.zeros(256, bool)
    out[[row.number for row in LINE_CLASSES.values() if fits(row)]] = True
    out[INTERIOR] = interior
    return out


@LINE_CLASSES.derived
def goes_on() -> npt.NDArray[np.bool_]:
    """(256,) by the class of an edge: the surface goes on there without a fold; not to be changed."""
    found = where(lambda row: row.tangent, interior=True)
    found.flags.writeable = False
    return found
