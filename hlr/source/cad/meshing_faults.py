"""Faces that could not be tessellated as they are, and the notes on them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from hlr.common.numbers import typed
from hlr.common.types import Ints
from hlr.drawing.notes import Note

MAX_LISTED = 5
"""Faces that one note lists by number."""


FAR = 1e6
"""Millimetres: beyond any model, so that the number tells nothing. Some surfaces run away to infinity at a corner."""


@dataclass(slots=True)
class MeshingFaults:
    """Numbers of underlying faces.

    lost        without triangles
    rescued     meshed by OpenCASCADE's mesher, not by the kernel
    crossed     neither mesher could: their outlines or holes cross or touch; meshed where these run around something
    turned      a loop of the face has the wrong orientation; it was meshed as if it had the right one
    folded      they lie on another face beside a common edge, on one surface
    torn        their surface folds over itself or jumps, and how far off the mesh may be there, in model units
    unfinished  their mesh took as many steps as it may before it was fine enough, and how far off it may be, in model
                units
    off         their edges lie off their surface in the model itself, and how far, in model units: those where it shows
    """

    lost: list[int] = field(default_factory=list)
    rescued: list[int] = field(default_factory=list)
    crossed: list[int] = field(default_factory=list)
    turned: list[int] = field(default_factory=list)
    folded: list[int] = field(default_factory=list)
    torn: dict[int, float] = field(default_factory=dict)
    unfinished: dict[int, float] = field(default_factory=dict)
    off: dict[int, float] = field(default_factory=dict)

    def __bool__(self) -> bool:
        found = (self.lost, self.rescued, self.crossed, self.turned, self.folded, self.torn, self.unfinished)
        return any(found)

    def notes(self, part: str, face_shape: Ints) -> list[Note]:
        """Notes on a part. face_shape (f,): for each of its faces the number of the underlying face."""
        lost, rescued, crossed, turned, folded = (
            _placed(numbers, face_shape)
            for numbers in (self.lost, self.rescued, self.crossed, self.turned, self.folded)
        )
        torn, unfinished = (_placed(list(numbers), face_shape) for numbers in (self.torn, self.unfinished))
        of = f'Part "{part}": {{}} of {len(face_shape)} faces'
        notes = []
        if lost:
            notes.append(Note("not-meshed", f"{of.format(len(lost))} could not be meshed ({_listed(lost)})."))
        if rescued:
            was = "was" if len(rescued) == 1 else "were"
            text = f"{of.format(len(rescued))} {was} meshed by OpenCASCADE ({_listed(rescued)})."
            notes.append(Note("faces-mended", text))
        if crossed:
            have = "has" if len(crossed) == 1 else "have"
            what = f"{have} outlines or holes that cross or touch, and may be drawn wrong there"
            notes.append(Note("loops-crossed", f"{of.format(len(crossed))} {what} ({_listed(crossed)})."))
        if turned:
            have = "has" if len(turned) == 1 else "have"
            what = f"{have} an outline or a hole that runs the wrong way round"
            notes.append(Note("loops-turned", f"{of.format(len(turned))} {what} ({_listed(turned)})."))
        if folded:
            what = "lie on one another beside a common edge: one may have been read as the rest of its surface"
            notes.append(Note("faces-folded", f"{of.format(len(folded))} {what} ({_listed(folded)})."))
        if torn:
            one = len(torn) == 1
            has = "has a surface that folds over itself or jumps" if one else "have surfaces that fold or jump"
            what = f"{has}, and may be {_off(self.torn, face_shape[torn])} there"
            notes.append(Note("surfaces-torn", f"{of.format(len(torn))} {what} ({_listed(torn)})."))
        if unfinished:
            takes = "takes" if len(unfinished) == 1 else "take"
            far = _off(self.unfinished, face_shape[unfinished])
            what = f"{takes} too much work to be meshed as finely as needed, and may be {far}"
            notes.append(Note("faces-too-coarse", f"{of.format(len(unfinished))} {what} ({_listed(unfinished)})."))
        return notes

    def off_note(self, parts: Iterable[tuple[str, Ints]]) -> Note:
        """The note on all faces that lie off their edges. parts: of each its name, and `face_shape` as above."""
        farthest = max(self.off, key=lambda number: self.off[number])
        places = ((name, np.flatnonzero(face_shape == farthest)) for name, face_shape in parts)
        name, face = next((name, int(found[0])) for name, found in places if len(found))
        where, far = f'face {face} of part "{name}"', f"up to {typed(self.off[farthest], 2)} mm off"
        if len(self.off) == 1:
            found = f"{where} lies {far} its own edges"
        else:
            found = f"{len(self.off)} faces lie {far} their own edges (the farthest is {where})"
        text = f"In the model itself {found}: lines there cannot be more exact than that."
        return Note("faces-off-edges", text)


def _placed(numbers: list[int], face_shape: Ints) -> list[int]:
    """The faces of a part with these underlying faces."""
    return np.flatnonzero(np.isin(face_shape, numbers)).tolist() if numbers else []


def _off(off: dict[int, float], numbers: Ints) -> str:
    """How far the farthest of some underlying faces is off, such as "0.12 mm off"."""
    farthest = max(off[number] for number in set(numbers.tolist()))
    return "far off" if farthest > FAR else f"{typed(farthest, 2)} mm off"


def _listed(faces: list[int]) -> str:
    """ "face 3", "faces 3, 4 and 7", "faces 3, 4, 5, 6, 7 and 12 more"; counted from 0, as in ids of lines."""
    if len(faces) == 1:
        return f"face {faces[0]}"
    last = f"{len(faces) - MAX_LISTED} more" if len(faces) > MAX_LISTED else str(faces[-1])
    shown = faces[:MAX_LISTED] if len(faces) > MAX_LISTED else faces[:-1]
    return f"faces {', '.join(map(str, shown))} and {last}"
