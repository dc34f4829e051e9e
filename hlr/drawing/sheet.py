"""A sheet: several views of a model on one page, under them what the page has printed on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hlr.drawing.section_marks import SectionMark


@dataclass(frozen=True, slots=True)
class SheetView:
    """One view on a sheet.

    name       unique on the sheet: the parts of the view are called by it, name/part
    label      what people call it
    scale      paper to model
    place      millimetres from the lower left corner of the page to the middle of the view
    rotation   degrees anticlockwise
    letter     of a section: A for A-A; empty where the model is whole
    direction  toward the viewer, in the model
    right      the direction in the model that points to the right on paper, before the rotation
    origin     millimetres: a point P of the model lies at ((P . right, P . up) * unit * scale, turned by the rotation)
               less this, with up = direction x right. None: the view is in perspective
    section    of a section a point on its plane, model units; None: the model is whole
    corners    where that plane steps, model units, as of `hlr.drawing.section.Section`
    """

    name: str
    label: str
    scale: float
    place: tuple[float, float]
    rotation: float
    direction: tuple[float, float, float]
    right: tuple[float, float, float]
    letter: str = ""
    origin: tuple[float, float] | None = None
    section: tuple[float, float, float] | None = None
    corners: tuple[tuple[float, float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Sheet:
    """What is on a page.

    views     in the order of the page
    method    by which the views are arranged, each of which shows the same parts: first-angle, third-angle. Empty: each
              view shows what it likes
    template  what is printed under them, and texts beside them, as SVG elements in millimetres from the page's upper
              left corner
    marks     of the sections among arranged views
    texts     in the fields of the template, such as those of its title block, by their keys
    """

    views: tuple[SheetView, ...]
    template: str = ""
    method: str = ""
    marks: tuple[SectionMark, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict, hash=False)


def views_of_parts(parts: Sequence[str], views: Sequence[str]) -> list[int]:
    """Of each part of a sheet the number of its view; -1: none. parts, views: their names."""
    numbers = {name: number for number, name in enumerate(views)}
    return [numbers.get(part.partition("/")[0], -1) for part in parts]
