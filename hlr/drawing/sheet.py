"""A sheet: several views of a model on one page, under them what the page has printed on it."""

from __future__ import annotations

from dataclasses import dataclass
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
    """

    name: str
    label: str
    scale: float
    place: tuple[float, float]
    rotation: float
    direction: tuple[float, float, float]
    right: tuple[float, float, float]
    letter: str = ""


@dataclass(frozen=True, slots=True)
class Sheet:
    """What is on a page.

    views     in the order of the page
    method    by which the views are arranged, each of which shows the same parts: first-angle, third-angle. Empty: each
              view shows what it likes
    template  what is printed under them, and texts beside them, as SVG elements in millimetres from the page's upper
              left corner
    marks     of the sections among arranged views
    """

    views: tuple[SheetView, ...]
    template: str = ""
    method: str = ""
    marks: tuple[SectionMark, ...] = ()
