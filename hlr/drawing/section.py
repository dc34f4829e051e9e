"""What a drawing says of the plane by which its model was cut."""

from __future__ import annotations

from dataclasses import dataclass

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Section:
    """The plane of a section, or its planes where it steps.

    point    on the plane, or on the first of them, in model coordinates
    normal   a direction in the model, of length 1, toward the viewer: what lay on its side was taken away
    parts    those that the plane cuts, whose cut faces are hatched: indices into Drawing.parts
    corners  of each step two points in model coordinates: on the edge of the plane before it, and of that behind it

    >>> import hlr
    >>> drawing = hlr.draw("part.step", view="front", section=True)
    >>> drawing.section.normal, drawing.section.parts
    ((0.0, -1.0, 0.0), (0,))
    """

    point: Vector
    normal: Vector
    parts: tuple[int, ...]
    corners: tuple[Vector, ...] = ()
