"""What went wrong with the faces of a model when they were triangulated, and the notes that say so."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hlr.common.types import Ints
from hlr.drawing.notes import Note

NAMED = 5
"""So many faces are named in one note."""


@dataclass(slots=True)
class MeshingFaults:
    """Numbers of underlying faces.

    lost: without triangles; rescued: meshed by OpenCASCADE's mesher instead of ours; turned: with an outline or a hole
    that runs the wrong way round, which was taken as if it did not.
    """

    lost: list[int] = field(default_factory=list)
    rescued: list[int] = field(default_factory=list)
    turned: list[int] = field(default_factory=list)

    def __bool__(self) -> bool:
        return bool(self.lost or self.rescued or self.turned)

    def notes(self, part: str, face_shape: Ints) -> list[Note]:
        """Notes on a part; face_shape: the number of the underlying face of each of its faces."""
        lost, rescued, turned = (
            np.flatnonzero(np.isin(face_shape, numbers)).tolist() if numbers else []
            for numbers in (self.lost, self.rescued, self.turned)
        )
        of = f'Part "{part}": {{}} of {len(face_shape)} faces'
        notes = []
        if lost:
            notes.append(Note("not-meshed", f"{of.format(len(lost))} could not be meshed ({_named(lost)})."))
        if rescued:
            was = "was" if len(rescued) == 1 else "were"
            text = f"{of.format(len(rescued))} {was} meshed by OpenCASCADE ({_named(rescued)})."
            notes.append(Note("faces-mended", text))
        if turned:
            have = "has" if len(turned) == 1 else "have"
            what = f"{have} an outline or a hole that runs the wrong way round"
            notes.append(Note("loops-turned", f"{of.format(len(turned))} {what} ({_named(turned)})."))
        return notes


def _named(faces: list[int]) -> str:
    """ "face 3", "faces 3, 4 and 7", "faces 3, 4, 5, 6, 7 and 12 more"; counted from 0, as in ids of lines."""
    if len(faces) == 1:
        return f"face {faces[0]}"
    last = f"{len(faces) - NAMED} more" if len(faces) > NAMED else str(faces[-1])
    shown = faces[:NAMED] if len(faces) > NAMED else faces[:-1]
    return f"faces {', '.join(map(str, shown))} and {last}"
