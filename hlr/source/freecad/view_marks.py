"""Whether and how a FreeCAD page marks a section and a detail in the view that they are made of."""

from __future__ import annotations

from hlr.drawing.view_marks import Mark
from hlr.source.freecad.added_lines import DASHES
from hlr.source.freecad.document import Object


def section_mark(base: Object, letter: str) -> Mark | None:
    """The mark of a section; None where the view shows none."""
    shown = base.view.flag("ShowSectionLine", True)
    return _mark(base, letter, "SectionLine") if shown else None


def detail_mark(base: Object, letter: str) -> Mark | None:
    """The mark of a detail; None where the view shows none."""
    shown = base.view.flag("ShowHighlight", True)
    return _mark(base, letter, "HighlightLine") if shown else None


def _mark(base: Object, letter: str, name: str) -> Mark | None:
    style = int(base.view.number(f"{name}Style", 2.0))
    color = f"#{int(base.view.number(f'{name}Color', 0.0)) >> 8 & 0xFFFFFF:06x}"
    return Mark(base.name, letter, color, DASHES.get(style, ())) if style else None
