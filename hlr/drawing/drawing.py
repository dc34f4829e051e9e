"""The drawing: lines on paper, each tied to its part and edge, and what is known about how they came to be."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Literal, overload

from hlr.common.values import ByValue
from hlr.drawing.fill import Fill
from hlr.drawing.line import Bounds, Line, Points
from hlr.drawing.lines import bounds_of
from hlr.drawing.notes import Note
from hlr.drawing.page import Page
from hlr.drawing.saving import render, write
from hlr.drawing.scale import ratio
from hlr.drawing.section import Section
from hlr.drawing.sheet import Sheet
from hlr.request.style import Style

if TYPE_CHECKING:
    from hlr.drawing.reached import Reached
    from hlr.drawing.saving import Format
    from hlr.request.effect import Decision
    from hlr.request.options import Request
    from hlr.request.style_file import StyleLike

Projection = Literal["orthographic", "perspective"]


@dataclass(frozen=True, slots=True)
class Accuracy:
    """How exact a drawing is.

    asked       millimetres on paper; None: the default
    used        millimetres on paper: what the drawing promises
    deflection  chord error of the triangulation, model units
    contact     depth within which two curved things count as touching, model units
    within      seconds, where a time was given; else None

    >>> import hlr
    >>> accuracy = hlr.draw("part.step", accuracy=0.1).accuracy
    >>> accuracy.asked, accuracy.used
    (0.1, 0.1)
    """

    asked: float | None
    used: float
    deflection: float = 0.0
    contact: float = 0.0
    within: float | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DrawnPart(ByValue):
    """A part as the drawing names it.

    name       unique in the drawing; on a page of several views that of the view stands before it: view/name
    color      sRGB, 0 to 1; None: the source gives none
    transform  (4, 4) matrix of its placement, row major, model units
    above      names of the assemblies that it is in, and of its place in them, where its own name does not say them:
               patterns of parts stand for these as well
    """

    name: str
    color: tuple[float, float, float] | None
    transform: Points
    above: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<DrawnPart {self.name!r}>"


@dataclass(frozen=True, slots=True)
class DrawnView:
    """The camera that was used, in model coordinates.

    name        of the view, such as "iso"; of one without a name its direction
    projection  "orthographic" or "perspective"
    direction   from the object toward the viewer, of length 1
    right, up   what points to the right and up on paper, of length 1
    eye         perspective only: where it is, model units
    target      perspective only: what it looks at, model units
    fov         perspective only: the vertical field of view, degrees
    distance    perspective only: of the image plane from the eye, model units
    """

    name: str
    projection: Projection
    direction: tuple[float, float, float]
    right: tuple[float, float, float]
    up: tuple[float, float, float]
    eye: tuple[float, float, float] | None = None
    target: tuple[float, float, float] | None = None
    fov: float | None = None
    distance: float | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Drawing(ByValue):
    """Visible and hidden lines of one view. points = (P.right, P.up) * unit * scale - origin.

    Drawings are equal that show and state the same; `request`, `timings` and `reading` do not count.

    source    base name of what was drawn
    view      the camera
    scale     paper to model
    origin    (x, y) millimetres: what the lower left corner of the drawing has been moved by, so that it is 0, 0
    parts     those that were drawn; lines name them by their place here
    lines     visible and hidden ones
    notes     warnings and remarks
    counters  how much was found or done, by name
    accuracy  what was asked for and what was used
    unit      millimetres per model unit
    up_axis   (3, 3) rotation matrix: model frame -> z-up world
    fill      faces under the lines, in SVG and PDF; None unless asked for
    timings   seconds: source, tessellate, scene, plan, visibility, linework, total
    request   what was asked for; None for drawings that were made otherwise
    reached   the errors that were measured; None unless asked for
    plan      for each effect whether it was on, why, and what it cost
    window    the rectangle on paper at which lines and fill were cut; None: nothing was cut
    section   the plane by which the model was cut; None: it was not
    page      the page, and where the drawing lies on it; None: the file is as large as the drawing or its window
    sheet     the views, where there are several; then `view` and `origin` are those of the page, which say nothing of
              the model; `scale` is that of all views, or 1 where each has its own
    style     how it looks, in SVG, PDF, DXF and PNG
    group     widths of wide and narrow lines, millimetres, because lines are crowded; a style that names widths
              overrides them. None: those of the page
    reading   how a CAD file was obtained, for people: read, or taken from the cache; not written to files

    >>> import hlr
    >>> drawing = hlr.draw("part.step", view="front", scale=1)
    >>> len(drawing.lines), len(drawing.visible), len(drawing.hidden)
    (6, 4, 2)
    >>> drawing.bounds
    Bounds(x0=0.0, y0=0.0, x1=30.0, y1=10.0)
    >>> drawing.to_svg()[:5]
    '<?xml'
    """

    source: str
    view: DrawnView
    scale: float
    origin: tuple[float, float]
    accuracy: Accuracy
    unit: float
    up_axis: tuple[tuple[float, float, float], ...]
    parts: tuple[DrawnPart, ...]
    lines: Sequence[Line] = field(hash=False)
    notes: tuple[Note, ...] = ()
    counters: Mapping[str, int] = field(default_factory=dict, hash=False)
    timings: Mapping[str, float] = field(default_factory=dict, compare=False)
    fill: Fill | None = None
    request: Request | None = field(default=None, compare=False)
    reached: Reached | None = None
    plan: Sequence[Decision] = ()
    window: Bounds | None = None
    section: Section | None = None
    page: Page | None = None
    sheet: Sheet | None = None
    style: Style = field(default_factory=Style)
    group: tuple[float, float] | None = None
    reading: str = field(default="", compare=False)

    def __repr__(self) -> str:
        notes = f", {len(self.notes)} note{'s' if len(self.notes) > 1 else ''}" if self.notes else ""
        visible = len(self.visible)
        return (
            f"<Drawing {self.source}, {self.view.name}, {ratio(self.scale)}, "
            f"{visible} visible and {len(self.lines) - visible} hidden lines{notes}>"
        )

    @property
    def visible(self) -> tuple[Line, ...]:
        """The visible lines, in their order."""
        return tuple(line for line in self.lines if line.visible)

    @property
    def hidden(self) -> tuple[Line, ...]:
        """The hidden lines, in their order."""
        return tuple(line for line in self.lines if not line.visible)

    @property
    def bounds(self) -> Bounds:
        """Around all lines; all zero for an empty drawing."""
        return bounds_of(self.lines)

    @property
    def area(self) -> Bounds:
        """The rectangle that SVG and PDF show: the page, or with a margin around it the window, or else the bounds."""
        if self.page is not None:
            return self.page.bounds
        return self.bounds if self.window is None else self.window

    def with_style(self, style: StyleLike) -> Drawing:
        """The same lines in another style; nothing is computed again.

        style: as of `hlr.draw`. Colours of the parts as fills show where the drawing was made with them, or with
        `fill`. Raises OptionError for a style that does not exist or says what is not allowed.

        >>> import hlr
        >>> drawing = hlr.draw("part.step")
        >>> drawing.with_style("blueprint").save("blue.svg").name
        'blue.svg'
        >>> drawing.with_style({"visible": {"color": "navy"}, "background": "none"}).style.background is None
        True
        """
        from hlr.request.style_file import style_of

        return replace(self, style=style_of(style))

    @overload
    def save(self, file: str | os.PathLike[str], format: Format | None = None) -> Path: ...
    @overload
    def save(self, file: IO[bytes], format: Format) -> None: ...
    def save(self, file: Any, format: Any = None) -> Path | None:
        """Write SVG, PDF, DXF, PNG or JSON into a file or a binary file object.

        file    a path, whose ending names the format, or a file object that is open for bytes
        format  svg, pdf, dxf, png or json: needed for a file object; of a path it overrides the ending

        Returns the path, or None for a file object. Raises WriteError, in one sentence, where the format is unknown or
        the file cannot be written.
        """
        return write(self, file, format)

    def to_svg(self) -> str:
        """The text of the SVG file. Raises WriteError where a point is not finite."""
        return render(self, "svg").decode("utf-8")

    def to_pdf(self) -> bytes:
        """The content of the PDF file. Raises WriteError where a point is not finite."""
        return render(self, "pdf")

    def to_dxf(self) -> bytes:
        """The content of the DXF file. Raises WriteError where a point is not finite."""
        return render(self, "dxf")

    def to_png(self) -> bytes:
        """The content of the PNG file, in the size or resolution of the style.

        Raises WriteError where a point is not finite, or there would be too many pixels.
        """
        return render(self, "png")

    def to_json(self) -> str:
        """The text of the exchange format, which `hlr.load` reads. Raises WriteError where a point is not finite."""
        return render(self, "json").decode("utf-8")

    def _repr_svg_(self) -> str:
        """For notebooks: the SVG."""
        return self.to_svg().partition("?>\n")[2]


def timed(drawing: Drawing, seconds: float) -> Drawing:
    """The drawing with the time that writing it took among its timings, and in their total."""
    total = drawing.timings.get("total", 0.0) - drawing.timings.get("write", 0.0) + seconds
    return replace(drawing, timings={**drawing.timings, "write": seconds, "total": total})
