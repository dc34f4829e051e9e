"""build123d: project_to_viewport with hlr's lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from hlr.compat import viewport
from hlr.compat.occt_edges import occt_edges
from hlr.drawing.drawing import Drawing
from hlr.drawing.line import Line
from hlr.errors import OptionError, SourceError, ViewError
from hlr.request.directions import CLOSEST, axes, normalized
from hlr.request.options import Vector
from hlr.source.cad.objects import to_leaves

if TYPE_CHECKING:
    from build123d import Edge, ShapeList


def project_to_viewport(
    shape: Any,
    viewport_origin: Any,
    viewport_up: Any = (0, 0, 1),
    look_at: Any = None,
    focus: float | None = None,
) -> tuple[ShapeList[Edge], ShapeList[Edge]]:
    """Project a shape onto a viewport; the same arguments, plane, place and scale as the method of a build123d shape.

    Args:
        shape: a build123d shape or builder.
        viewport_origin: where the viewport is.
        viewport_up: what points up in it. Seen from above along z, where z cannot, y points up, and from below minus y.
        look_at: the point looked at; None: the shape's centre.
        focus: in perspective, how far before the viewport the eye is; None: parallel rays.

    Returns:
        Visible and hidden edges: lines, circles, ellipses, Bezier curves and B-splines. A polyline comes as its
        segments. The label of an edge says what it is of: "part/edge 7", "part/face 3" for an outline, "part/other
        part" where two parts meet.

    Raises:
        HlrError: the shape or the view cannot be drawn; the message says why.
    """
    from build123d import Edge as EdgeOf
    from build123d import ShapeList as ListOf

    shape = _shape(shape)
    origin = _point(viewport_origin, "viewport_origin")
    target = _point(shape.center() if look_at is None else look_at, "look_at")
    x, y, z = (o - t for o, t in zip(origin, target, strict=True))
    if max(abs(x), abs(y), abs(z)) <= CLOSEST * max(1.0, *map(abs, origin)):
        raise ViewError("viewport_origin is the point it looks at: move it away from look_at")
    up = _across(_point(viewport_up, "viewport_up"), (x, y, z))
    length = viewport.check_positive(focus, "focus") if focus else None
    picture = viewport.draw_viewport(shape, viewport.Viewport(origin, (x, y, z), up, length))
    found: dict[bool, list[Edge]] = {True: [], False: []}
    for line in picture.drawing.lines:
        label = _label(picture.drawing, line)
        for made in occt_edges(line, picture.shift):
            edge = EdgeOf(made)
            edge.label = label
            found[line.visible].append(edge)
    return ListOf(found[True]), ListOf(found[False])


def _across(up: Vector, direction: Vector) -> Vector:
    """What points up; where both are along z, what points up in a view of hlr from above or below."""
    along_z = all(max(abs(v[0]), abs(v[1])) < CLOSEST * abs(v[2]) for v in (up, direction))
    return axes(normalized(direction, "the view direction"), None)[1] if along_z else up


def _shape(thing: Any) -> Any:
    """A build123d shape, of a builder what it has built."""
    from build123d import Builder, Shape

    if isinstance(thing, Builder):
        built = (getattr(thing, name, None) for name in ("part", "sketch", "line"))
        thing = next((shape for shape in built if shape is not None), thing)
    if not isinstance(thing, Shape):
        raise SourceError(f"An object of type {type(thing).__name__} cannot be projected: pass a build123d shape.")
    if not to_leaves(thing, ""):
        raise SourceError(f"{type(thing).__name__} holds no shapes: there is nothing to project.")
    return thing


def _point(value: Any, what: str) -> Vector:
    """What build123d takes for a vector, as three finite numbers."""
    from build123d import Vector as VectorOf

    try:
        point = VectorOf(value)
    except (TypeError, ValueError, AttributeError):
        raise OptionError(f"{what} needs three finite numbers, such as (1, -1, 1), not {value!r}") from None
    return viewport.check_vector((point.X, point.Y, point.Z), what)


def _label(drawing: Drawing, line: Line) -> str:
    part = drawing.parts[line.part].name
    if line.edge is not None:
        return f"{part}/edge {line.edge}"
    if line.other is not None:
        return f"{part}/{drawing.parts[line.other].name}"
    return part if line.face is None else f"{part}/face {line.face}"
