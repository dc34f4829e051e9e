"""What is wrong with a part, in words."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from hlr.notes import Note
from hlr.scene.scene import INTERIOR, Groups, ScenePart
from hlr.scene.topology import MeshFacts
from hlr.source.model import Ints, PartMesh

MOST_NOTES = 5
"""Parts that are named in the notes; how many more there are is said in one sentence."""


def reports(
    parts: list[PartMesh],
    doubled: list[int],
    mesh: MeshFacts,
    kind: npt.NDArray[np.uint8],
    part_of: Ints,
    edge_part: Ints,
    groups: Groups,
    group_part: Ints,
    inward: npt.NDArray[np.bool_],
    crossed: Ints,
) -> tuple[ScenePart, ...]:
    """Per part what it is and what is wrong with it.

    doubled: triangles already left out as duplicates; kind: of all mesh edges; part_of (t,); edge_part (e,); group_part
    (g,); inward: (g,) bool, what had to be turned outward; crossed: numbers of parts whose surfaces pass through one
    another.
    """
    n = len(parts)
    uses = np.diff(mesh.offsets)
    own = edge_part[: len(uses)]

    def per_part(edges: npt.NDArray[np.bool_]) -> npt.NDArray[np.intp]:
        return np.bincount(own[edges], minlength=n)

    border, crowded = per_part(uses == 1), per_part(uses > 2)
    turned = per_part((uses == 2) & (mesh.balance != 0))
    drawn = per_part(kind[: len(own)] != INTERIOR)
    flat = np.bincount(part_of[mesh.flat], minlength=n)

    def groups_of_part(chosen: npt.NDArray[np.bool_]) -> npt.NDArray[np.intp]:
        return np.bincount(group_part[chosen], minlength=n)

    unclosed, outside_in = groups_of_part(~groups.closed), groups_of_part(inward)
    triangles = np.bincount(part_of, minlength=n)
    through = set(crossed.tolist())
    out = []
    for i, part in enumerate(parts):
        defects = []
        if doubled[i]:
            defects.append(_count(doubled[i], "duplicated triangle"))
        if flat[i] and not part.brep:  # those of a B-rep are the triangulator's, not the model's
            defects.append(_count(flat[i], "triangle") + " without area")
        if border[i]:
            defects.append("open: " + _count(border[i], "border edge"))
        if crowded[i]:
            defects.append(_count(crowded[i], "non-manifold edge"))
        if turned[i]:
            defects.append(_count(turned[i], "edge") + " between faces of opposite orientation")
        if outside_in[i]:
            pieces = _count(outside_in[i], "closed piece") + " turned inside out"
            defects.append("the solid is turned inside out" if part.brep else pieces)
        if i in through:
            defects.append("the surface passes through itself")
        out.append(
            ScenePart(
                name=part.name,
                color=part.color,
                transform=part.transform,
                faces=len(part.face_planar) if part.brep else 0,
                edges=_distinct(part.edge_index) if part.brep else int(drawn[i]),
                triangles=int(triangles[i]),
                closed=bool(triangles[i] > 0 and not border[i] and not unclosed[i]),
                oriented=bool(turned[i] == 0),
                defects=tuple(defects),
            )
        )
    return tuple(out)


def notes(parts: tuple[ScenePart, ...]) -> list[Note]:
    """One sentence per defective part, for the first few."""
    bad = [p for p in parts if p.defects]
    out = [Note("defects", f'Part "{p.name}" is drawn as it is: {"; ".join(p.defects)}.') for p in bad[:MOST_NOTES]]
    if len(bad) > MOST_NOTES:
        more = len(bad) - MOST_NOTES
        text = f"{more} more part{' has' if more == 1 else 's have'} defects: see hlr info."
        out.append(Note("more-defects", text))
    return out


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _distinct(ascending: Ints) -> int:
    """How many different numbers there are; an edge that changes its class is there in pieces."""
    return int(np.count_nonzero(np.diff(ascending))) + (len(ascending) > 0)
