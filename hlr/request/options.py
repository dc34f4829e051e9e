"""The request: one frozen, typed record for everything a drawing can be asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypedDict

from hlr.request.defaults import CREASE
from hlr.request.style_file import StyleLike

Vector = tuple[float, float, float]

ViewName = Literal[
    "front", "back", "left", "right", "top", "bottom", "iso", "iso-se", "iso-sw", "iso-ne", "iso-nw"
]  # fmt: skip
"""Views with a name; `hlr.request.directions` says where each looks from."""

View = ViewName | Sequence[float]
"""A named view or a direction from the object toward the viewer."""

Parameter = bool | int | float | str
"""A value for a variable of a script."""

Steps = tuple[float | tuple[float, float], ...]
"""Of a plane that steps: its first coordinate, then pairs: from where on, and at which coordinate."""

SectionPlace = bool | float | Vector | Steps
"""Where a view is cut: True for the middle, a coordinate, a point on the plane, or steps (`hlr.request.section`)."""

SectionLike = SectionPlace | Mapping[str, SectionPlace] | Sequence[tuple[str, SectionPlace]]
"""Where all views are cut, or some of them, by name; pairs where several planes cut one view."""


@dataclass(frozen=True, slots=True)
class Perspective:
    """A perspective camera. Places are those of the world (z up), whatever units and axes the model's own file has.

    eye     where it is, millimetres; None: far enough along the view direction for the whole model to fit
    target  what it looks at, millimetres; None: the middle of the model
    fov     vertical field of view, degrees; None: as wide as the model needs, at most 120

    >>> import hlr
    >>> drawing = hlr.draw("part.step", perspective=hlr.Perspective(fov=50))
    >>> drawing.view.projection, drawing.view.fov
    ('perspective', 50)
    """

    eye: Vector | None = None
    target: Vector | None = None
    fov: float | None = None


@dataclass(frozen=True, slots=True)
class Options:
    """What is asked of a drawing. Lengths are millimetres on paper unless said otherwise.

    hidden       draw hidden lines; None: in views along an axis of the model, not in pictorial ones and sections
    smooth       draw tangent (G1) edges, thin; None: in pictorial views (oblique or in perspective), not in others
    seam         draw the seams of closed surfaces
    intersections  draw the lines in which surfaces pass through one another
    scale        paper : model; 0.5 or "1:2". None, and no `fit`: the largest standard scale (ISO 5455) at which the
                 drawing fits its page inside margins of 10 mm
    fit          instead of a scale: (width, height) to fit the drawing into, or the name of a sheet to fill
    page         the name of a sheet, such as "A3" or "letter-portrait", or (width, height) in millimetres. A sheet lies
                 the way that allows the larger scale. None: A4; with a scale or a size to fit into, the page is as
                 large as the drawing
    same_scale   all views have one scale: the smallest of those they would have otherwise
    window       (x0, y0, x1, y1): only this rectangle of the drawing, in the coordinates that it has without a window:
                 its lower left corner is 0, 0; lines are cut at the sides, and what lies outside still hides
    accuracy     None: 0.05, or a two-thousandth of the drawing's diagonal where that is less
    crease       degrees: where a mesh without B-rep folds more than this, an edge is drawn
    circles      creases and borders of a mesh become circles where every vertex lies on one within the accuracy, and
                 neighbours are less than the crease angle (and 45 degrees) apart
    section      cut the model by a plane across the view, and take away what lies before it: True for the middle of the
                 model; a number, the coordinate on the axis that the view looks along; a point on the plane; or
                 (12.5, (30, 40)) where the plane steps: at 12.5, and from 30 on, on the axis across the view, at 40;
                 all in millimetres in the world, as an eye; or these by the names of the views that are cut:
                 {"front": True, "left": 12.5}; or pairs of a view and its place, where several planes cut one view:
                 [("left", 12.5), ("left", 40)], of which each is a drawing. Cut faces are hatched
    whole        views that are drawn whole besides their sections, as ("left",): the view and its sections are each a
                 drawing, called left, left-A and so on. Else a section takes the place of its view
    uncut        patterns of parts that sections leave whole, as bolts, shafts and ribs are by custom
    up           the direction that points up on paper; None: the named view's own, else z (y for views along z)
    perspective  None: orthographic
    see_through  parts that their file says are transparent hide nothing; else they hide like all others
    details      draw also what the pen cannot show: figures smaller than it, and lines between others that are closer
                 together than it is wide; and keep its width where lines are crowded
    fill         paint what is seen of the faces, shaded, under the lines (SVG and PDF)
    style        how the drawing looks: the name of a built-in style (iso, asme, thin, dark, blueprint), the path of a
                 TOML file, the same tables as a dictionary, or a `Style`
    threads      0: all cores
    strict       warnings are errors
    only, hide   patterns of parts: only those are drawn, or all but those; letters of any case, * and ? as in file
                 names; a name without its number means all of that name, that of an assembly all that is in it
    var          the variable of a script to draw, instead of what it shows
    parameters   values for variables of a script that it sets to plain numbers, texts, True or False: {"size": 20}
    annotations  draw the faces of annotation in STEP files: those that the file hides, or calls supplemental geometry
    hidden_objects  draw also the objects that a FreeCAD document hides
    report       measure what accuracy was reached: `Drawing.reached`; takes several times as long as the drawing
    within       seconds: draw coarsely first, then finer while time lasts, though not finer than `accuracy`; where
                 none is given, than a 25th of the default

    >>> import hlr
    >>> options = hlr.Options(scale=2.0, hidden=False)
    >>> hlr.draw_views("part.step", ["iso"], options)
    [<Drawing part.step, iso, 2:1, 10 visible and 0 hidden lines>]
    """

    hidden: bool | None = None
    smooth: bool | None = None
    seam: bool = False
    intersections: bool = True
    scale: float | str | None = None
    fit: tuple[float, float] | str | None = None
    page: tuple[float, float] | str | None = None
    same_scale: bool = False
    window: tuple[float, float, float, float] | None = None
    accuracy: float | None = None
    crease: float = CREASE
    circles: bool = False
    section: SectionLike | None = field(default=None, hash=False)
    whole: ViewName | Sequence[View] = field(default=(), hash=False)
    uncut: tuple[str, ...] = ()
    up: Vector | None = None
    perspective: Perspective | None = None
    see_through: bool = False
    details: bool = False
    fill: bool = False
    threads: int = 0
    strict: bool = False
    report: bool = False
    within: float | None = None
    only: tuple[str, ...] = ()
    hide: tuple[str, ...] = ()
    var: str | None = None
    parameters: Mapping[str, Parameter] | None = field(default=None, hash=False)
    annotations: bool = False
    hidden_objects: bool = False
    style: StyleLike | None = None


class Chosen(TypedDict, total=False):
    """What is chosen of a model, as keywords: fields of `Options`, of pictures and of comparisons."""

    only: tuple[str, ...]
    hide: tuple[str, ...]
    var: str | None
    parameters: Mapping[str, Parameter] | None
    annotations: bool
    hidden_objects: bool


class Wishes(Chosen, total=False):
    """The fields of `Options` as the keywords of `hlr.draw`: none has to be given."""

    hidden: bool | None
    smooth: bool | None
    seam: bool
    intersections: bool
    scale: float | str | None
    fit: tuple[float, float] | str | None
    page: tuple[float, float] | str | None
    same_scale: bool
    window: tuple[float, float, float, float] | None
    accuracy: float | None
    crease: float
    circles: bool
    section: SectionLike | None
    whole: ViewName | Sequence[View]
    uncut: tuple[str, ...]
    up: Vector | None
    perspective: Perspective | None
    see_through: bool
    details: bool
    fill: bool
    threads: int
    style: StyleLike | None
    strict: bool
    report: bool
    within: float | None


@dataclass(frozen=True, slots=True)
class Request:
    """What was asked for. Asked again, it gives the same drawing.

    view     a name, or the direction from the object toward the viewer
    options  all else
    """

    view: View
    options: Options
