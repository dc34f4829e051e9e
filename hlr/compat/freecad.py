"""FreeCAD: TechDraw.projectEx on its own shapes, and on those of OpenCASCADE, CadQuery and build123d."""

from __future__ import annotations

from typing import Any

from hlr.compat import viewport
from hlr.compat.occt_edges import occt_compound
from hlr.source.freecad.objects import is_freecad, to_freecad
from hlr.tables.line_classes import by_number

COMPOUNDS = ("sharp", "smooth", "sewn", "outline", "isoparametric")
"""In the order of the result."""


def project_ex(shape: Any, direction: Any = (0.0, 0.0, 1.0)) -> list[Any]:
    """Project a shape, and sort its edges by visibility and kind.

    Args:
        shape: a shape or an object of FreeCAD's, an OpenCASCADE shape, a CadQuery or build123d object, or whatever
            else `hlr.draw` takes.
        direction: toward the viewer, three numbers or a FreeCAD.Vector.

    Returns:
        Ten compounds of edges in the XY plane, in model units: [V, V1, VN, VO, VI, H, H1, HN, HO, HI], visible and
        then hidden sharp, smooth, sewn, outline and isoparametric lines. Each is a TopoDS_Compound, or a Part.Shape
        where what was given is FreeCAD's. One without lines is empty, not None.
        Isoparametric lines are never drawn. Sewn lines are the seams of closed faces. Lines in which parts pass through
        one another, which OpenCASCADE does not know, are among the sharp ones.

    Raises:
        HlrError: the shape or the direction cannot be drawn; the message says why.
    """
    picture = viewport.draw_viewport(shape, viewport.viewport_along(direction, "direction"), seam=True)
    kinds = [[row.name for row in by_number() if row.occt == name] for name in COMPOUNDS]
    found = [occt_compound(picture.lines(some, visible), picture.shift) for visible in (True, False) for some in kinds]
    return [to_freecad(compound) for compound in found] if is_freecad(shape) else found
