"""Defects of parts, in words."""

from __future__ import annotations

from hlr.common.types import Ints
from hlr.drawing.notes import Note
from hlr.scene.scene import ScenePart
from hlr.source.part_meshes import PartMeshes

MAX_NOTES = 5
"""Defective parts with a note of their own; one more note has the number of all others."""


def part_reports(
    whole: PartMeshes,
    doubled: list[int],
    counts: list[list[int]],
    drawn: list[int] | None,
    crossed: Ints,
) -> tuple[ScenePart, ...]:
    """One report per part: identity, counts and defects.

    counts: what `_kernel.MeshScene.reports` tells; doubled: triangles already left out as duplicates; drawn: edges of
    parts without B-rep, None where there are none; crossed: numbers of parts whose surfaces pass through one another.
    """
    through = set(crossed.tolist())
    tables = whole.tables
    brep = tables.brep.tolist()
    faces = (tables.face_start[1:] - tables.face_start[:-1]).tolist()
    own = drawn or [0] * len(brep)
    out = []
    for i, (label, found) in enumerate(zip(whole.labels, counts, strict=True)):
        border, crowded, turned, flat, unclosed, outside_in, triangles, edges = found
        defects = []
        if doubled[i]:
            defects.append(_count(doubled[i], "duplicated triangle"))
        if flat and not brep[i]:  # in a B-rep they are due to the tessellation, not to the model
            defects.append(_count(flat, "triangle") + " without area")
        if border:
            defects.append("open: " + _count(border, "border edge"))
        if crowded:
            defects.append(_count(crowded, "non-manifold edge"))
        if turned:
            defects.append(_count(turned, "edge") + " between faces of opposite orientation")
        if outside_in:
            pieces = _count(outside_in, "closed piece") + " turned inside out"
            defects.append("the solid is turned inside out" if brep[i] else pieces)
        if i in through:
            defects.append("the surface passes through itself")
        out.append(
            ScenePart(
                name=label.name,
                color=label.color,
                transform=label.transform,
                faces=faces[i] if brep[i] else 0,
                edges=edges if brep[i] else own[i],
                triangles=triangles,
                closed=triangles > 0 and not border and not unclosed,
                oriented=turned == 0,
                defects=tuple(defects),
            )
        )
    return tuple(out)


def defect_notes(parts: tuple[ScenePart, ...]) -> list[Note]:
    """One note per defective part, MAX_NOTES at most, and one for all others."""
    bad = [p for p in parts if p.defects]
    out = [Note("defects", f'Part "{p.name}" is drawn as it is: {"; ".join(p.defects)}.') for p in bad[:MAX_NOTES]]
    if len(bad) > MAX_NOTES:
        more = len(bad) - MAX_NOTES
        text = f"{more} more part{' has' if more == 1 else 's have'} defects: see hlr info."
        out.append(Note("more-defects", text))
    return out


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
