"""Layers of DXF, and what entities have of their own: colour, linetype and lineweight, as a drawing's style says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from typing import TYPE_CHECKING

import numpy as np

from hlr.common.colors import rgb_of
from hlr.drawing.drawing import Drawing
from hlr.drawing.lines import held
from hlr.drawing.pens import Pen, PenSet, by_part, pens_of, usual_pens_of
from hlr.tables.line_classes import names
from hlr.writers.dxf_text import FORBIDDEN

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

Key = tuple[int, int, bool]
"""Whose tags: the part, the number of the line class, whether it is visible."""

FILL = "FILL"
"""The layer of filled faces."""

MARKS = "SECTION_MARKS"
"""The layer of cutting lines, and of the names of sections."""

TEMPLATE = "TEMPLATE"
"""The layer of what a page has printed on it: a frame, a title block."""

CONTRAST = 7
"""Number of the colour that is black on white and white on black."""

SHORT_DASHED, SHORT_HIDDEN = "DASHED2", "HIDDEN2"
"""Linetypes. CAD programs have some of these names, nearly as long; LibreCAD draws its own in place of the file's."""

LONGEST, LONGEST_R12 = 255, 31
"""Characters of a name."""

_NO_NAME = re.compile(r"[<>/\\\":;?*|=,`'^]")
_NO_NAME_R12 = re.compile(r"[^A-Z0-9$_-]")


@dataclass(frozen=True, slots=True)
class Look:
    """What DXF knows of a pen. number, rgb: the nearest of its 255 colours, and the colour itself where that differs;
    linetype: by name; lineweight: hundredths of a millimetre."""

    number: int
    rgb: int | None
    linetype: str
    lineweight: int


@dataclass(slots=True)
class Layers:
    """The layers of a document. modern: its version is not R12; true_colors: it has others than the 255."""

    document: Document
    drawing: Drawing
    modern: bool
    true_colors: bool
    looks: dict[str, Look] = field(default_factory=dict)
    named: dict[str, str] = field(default_factory=dict)
    taken: set[str] = field(
        default_factory=lambda: {"0", "defpoints", *(own.casefold() for own in (FILL, MARKS, TEMPLATE))}
    )
    dashes: dict[tuple[float, float], str] = field(default_factory=dict)

    def tags(self) -> dict[Key, str]:
        """Makes the layers; returns tags that put an entity on its layer and give it what the layer does not.

        A layer of a class has the pen of the class, one of a part that of the part's visible lines.
        """
        style = self.drawing.style
        usual = usual_pens_of(self.drawing)
        pens, classes = by_part(pens_of(self.drawing, usual)), names()
        seen: dict[tuple[int, str | None, bool], Look] = {}

        def look(own: PenSet, kind: str | None, visible: bool) -> Look:
            key = (id(own), kind, visible)
            if key not in seen:
                seen[key] = self._look(own.pen(kind, visible), visible)
            return seen[key]

        found = {}
        for part, kind, visible in _there(self.drawing):
            if style.layers == "part":
                name = self._name(self.drawing.parts[part].name)
                whole = look(pens[part], None, True)
            else:
                name = f"{'VISIBLE' if visible else 'HIDDEN'}_{classes[kind].upper()}"
                whole = look(usual, classes[kind], visible)
            found[part, kind, visible] = self._on(name, whole, look(pens[part], classes[kind], visible))
        return found

    def _look(self, pen: Pen, visible: bool) -> Look:
        number, rgb = nearest_color(pen.solid)
        linetype = "CONTINUOUS"
        if pen.dash is not None:
            linetype = self.dashes.get(pen.dash) or self._linetype(pen.dash, SHORT_DASHED if visible else SHORT_HIDDEN)
        return Look(number, rgb if self.true_colors else None, linetype, lineweight(pen.width))

    def _linetype(self, dash: tuple[float, float], name: str) -> str:
        """A new linetype; of several of one name the later ones have numbers."""
        others = sum(made.startswith(name) for made in self.dashes.values())
        name = f"{name}_{others + 1}" if others else name
        self.document.linetypes.add(name, [sum(dash), dash[0], -dash[1]], description="__ __ __ __ __ __ __ __")
        self.dashes[dash] = name
        return name

    def _on(self, name: str, usual: Look, look: Look) -> str:
        """The tags of entities with that look on a layer, which is made if it is new, with the usual look."""
        usual = self.looks.setdefault(name, usual)
        if name not in self.document.layers:
            self.document.layers.add(
                name, color=usual.number, true_color=usual.rgb, linetype=usual.linetype, lineweight=usual.lineweight
            )
        tags = f"8\n{name}\n"
        if look.linetype != usual.linetype:
            tags += f"6\n{look.linetype}\n"
        if (look.number, look.rgb) != (usual.number, usual.rgb):
            tags += f"62\n{look.number}\n"
            tags += "" if look.rgb is None else f"420\n{look.rgb}\n"
        if self.modern and look.lineweight != usual.lineweight:
            tags += f"370\n{look.lineweight}\n"
        return tags

    def _name(self, part: str) -> str:
        """A legal name for the layer of parts of that name. Layers differ in more than capitals."""
        if part in self.named:
            return self.named[part]
        most = LONGEST if self.modern else LONGEST_R12
        legal = _NO_NAME.sub("_", FORBIDDEN.sub("_", part)) if self.modern else _NO_NAME_R12.sub("_", part.upper())
        base = name = legal.strip()[:most].strip() or "part"
        for number in count(2):
            if name.casefold() not in self.taken:
                break
            ending = f"_{number}"
            name = base[: most - len(ending)] + ending
        self.taken.add(name.casefold())
        self.named[part] = name
        return name


def _there(drawing: Drawing) -> Iterator[Key]:
    """All that the drawing has lines of: visible ones first, then by class, then by part."""
    lines = held(drawing.lines)
    part = lines.columns()["ties"][:, 0]
    keys = np.stack([~lines.visible(), lines.kinds(), part], axis=1).astype(np.int64)
    for hidden, kind, whose in np.unique(keys, axis=0).tolist():
        yield whose, kind, not hidden


@cache
def nearest_color(color: str) -> tuple[int, int | None]:
    """The nearest of DXF's numbered colours, and the colour itself as a number where it is another.

    Black and white are one colour, so that lines show on any background.
    """
    from ezdxf.colors import DXF_DEFAULT_COLORS, int2rgb, rgb2int

    wanted = rgb_of(color)
    if wanted in ((0, 0, 0), (255, 255, 255)):
        return CONTRAST, None
    there = {k: int2rgb(DXF_DEFAULT_COLORS[k]) for k in range(1, 256) if k != CONTRAST}
    near = {k: sum((a - b) ** 2 for a, b in zip(rgb, wanted, strict=True)) for k, rgb in there.items()}
    number = min(near, key=lambda k: near[k])
    return number, None if near[number] == 0 else int(rgb2int(wanted))


@cache
def lineweight(width: float) -> int:
    """The nearest width that DXF has, in hundredths of a millimetre."""
    from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS

    return int(min(VALID_DXF_LINEWEIGHTS, key=lambda each: abs(each - 100.0 * width)))
