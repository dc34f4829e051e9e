"""Named views, view directions, and what points up: all that a camera knows before the model is read.

`NAMED` holds for each name the direction from the object toward the viewer, and the direction that points up on paper
(world axes, z up).

Front looks along +y with x to the right, as in FreeCAD and ISO 5456-2; the isometrics are named by the compass corner
the viewer stands at, as in AutoCAD.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from difflib import get_close_matches

from hlr.errors import ViewError
from hlr.request.options import Perspective, Vector, View, ViewName

NAMED: dict[ViewName, tuple[Vector, Vector]] = {
    "front": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "back": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "left": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "right": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "bottom": ((0.0, 0.0, -1.0), (0.0, -1.0, 0.0)),
    "iso": ((1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-se": ((1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-sw": ((-1.0, -1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-ne": ((1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
    "iso-nw": ((-1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
}

EYE = "eye"
"""Name of a view from a given eye point."""

CLOSEST = 1e-9
"""Share of the coordinates and of the model's size: an eye nearer to its target than this has no direction."""


SLANT = 1e-9
"""Least component of a view's direction along an axis: with less, it does not lean toward that axis."""


def check_directions(views: Sequence[View], up: Vector | None, perspective: Perspective | None) -> None:
    """Check cameras as far as that is possible before the model is read.

    Raises ViewError for an unknown name, a zero direction, up parallel to a direction, and several views from one eye.
    """
    if perspective is None or perspective.eye is None:
        for view in views:
            direction, named_up = _aimed(view)
            axes(direction, named_up if up is None else up)
        return
    if len(views) > 1:
        raise ViewError(f"{len(views)} views from one eye would be the same: give one view, or no eye")
    if perspective.target is None:
        if up is not None:
            normalized(up, "`up`")
        return
    apart(perspective.eye, perspective.target, 0.0)
    way = [e - t for e, t in zip(perspective.eye, perspective.target, strict=True)]
    axes(normalized(way, "the way from target to eye"), up)


def cross(a: Vector, b: Vector) -> Vector:
    """a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(v: Sequence[float], what: str) -> Vector:
    """The unit vector v / |v|. what: its name in errors. Raises ViewError for a vector without direction."""
    if len(v) != 3 or not all(map(math.isfinite, v)):
        raise ViewError(f"{what} needs three finite numbers, not {', '.join(str(c) for c in v)}")
    x, y, z = map(float, v)
    # Scaled first, so that neither 1e-200 nor 1e200 is lost in the squares.
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        raise ViewError(f"{what} is zero: give a direction such as 1,-1,1")
    x, y, z = x / largest, y / largest, z / largest
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)


def directed(view: View) -> tuple[str, Vector, Vector | None]:
    """A view's name, its unit direction toward the viewer, and the up direction that a named view has; world axes."""
    direction, up = _aimed(view)
    return view if isinstance(view, str) else ",".join([f"{float(c):g}" for c in view]), direction, up


def is_several(text: str) -> bool:
    """Whether it is names of two views or more, such as front,top."""
    names = text.lower().replace(",", " ").replace(";", " ").split()
    return len(names) > 1 and all(name in NAMED for name in names)


def _meant(name: str) -> str:
    """What to give instead of the name of a view that there is not: the nearest one, or what there is."""
    if is_several(name):
        return "draw_views draws several"
    near = get_close_matches(name.lower(), NAMED, 1)
    return f"did you mean {near[0]}?" if near else f"use {', '.join(NAMED)}, or a direction such as 1,-1,1"


def _aimed(view: View) -> tuple[Vector, Vector | None]:
    """The same without the name."""
    if isinstance(view, str):
        if view not in NAMED:
            raise ViewError(f"no view is called '{view}': {_meant(view)}")
        direction, up = NAMED[view]
        return normalized(direction, "the view direction"), up
    if isinstance(view, bytes | bytearray):
        raise ViewError("a view in bytes: give its name as text, or a direction such as (1, -1, 1)")
    return normalized(tuple(view), "the view direction"), None


def axes(direction: Vector, up_hint: Vector | None) -> tuple[Vector, Vector]:
    """The unit vectors that point right and up on paper, world axes. Raises ViewError for an up along the view."""
    if up_hint is not None:
        up = normalized(up_hint, "`up`")
    elif abs(direction[2]) > 1.0 - 1e-12:
        # Looking along z, y points up: the top view turned by nothing.
        up = (0.0, 1.0 if direction[2] > 0.0 else -1.0, 0.0)
    else:
        up = (0.0, 0.0, 1.0)
    side = cross(up, direction)
    if max(map(abs, side)) < 1e-9:
        raise ViewError("`up` is parallel to the view direction: give another direction")
    right = normalized(side, "right")
    # The cross product of unit vectors is a unit vector up to rounding.
    return right, normalized(cross(direction, right), "up")


def pictorial(direction: Vector) -> bool:
    """Whether a parallel view along this unit vector (world axes) shows more than two of the model's dimensions."""
    return sum([abs(c) > SLANT for c in direction]) > 1


def apart(eye: Vector, target: Vector, radius: float) -> None:
    """Raises ViewError where eye and target are the same point up to rounding. radius: half the model's diagonal."""
    largest = max(radius, *(abs(c) for c in (*eye, *target)))
    if max(abs(e - t) for e, t in zip(eye, target, strict=True)) <= CLOSEST * largest:
        raise ViewError("eye and target are one point: move the eye away from what it looks at, or the target nearer")
