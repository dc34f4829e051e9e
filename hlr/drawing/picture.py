"""The shaded picture: its pixels, and on request a depth map and a map of faces."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from hlr.common.values import ByValue
from hlr.drawing.drawing import DrawnPart, DrawnView
from hlr.drawing.notes import Note
from hlr.drawing.saving import write_picture
from hlr.tables.writers import PICTURE

if TYPE_CHECKING:
    from hlr.request.effect import Decision

File = str | os.PathLike[str]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Picture(ByValue):
    """One view, shaded. Pictures are equal that show the same; `timings` do not count.

    source      base name of what is shown
    view        the camera
    parts       those that are shown
    notes       warnings and remarks
    scale       pixels per millimetre of the model, in the image plane
    pixels      (h, w, 4) uint8: red, green, blue (sRGB) and straight opacity
    depth       (h, w) float64: millimetres from the eye's plane, along the view, of what is seen at the centre of each
                pixel (in parallel views from the plane through the origin); infinite where there is nothing; else None
    ids         (h, w) int32: number of the face seen there, -1 for none; faces of all parts are numbered together,
                part i from first_face[i] on; else None
    first_face  (p + 1,) int32
    timings     seconds: source, tessellate, scene, prepare, picture, edges, total
    plan        for each effect whether it was on, and why

    >>> import hlr
    >>> picture = hlr.preview("part.step", size=(320, 240), depth=True)
    >>> picture.pixels.shape, picture.depth.shape
    ((240, 320, 4), (240, 320))
    """

    source: str
    view: DrawnView
    scale: float
    pixels: npt.NDArray[np.uint8]
    parts: tuple[DrawnPart, ...]
    first_face: npt.NDArray[np.int32]
    depth: npt.NDArray[np.float64] | None = None
    ids: npt.NDArray[np.int32] | None = None
    notes: tuple[Note, ...] = ()
    timings: Mapping[str, float] = field(default_factory=dict, compare=False)
    plan: tuple[Decision, ...] = ()

    def __repr__(self) -> str:
        height, width = self.pixels.shape[:2]
        maps = "".join(f", {name}" for name, made in (("depth", self.depth), ("ids", self.ids)) if made is not None)
        return f"<Picture {self.source}, {self.view.name}, {width}x{height} pixels{maps}>"

    @property
    def part_ids(self) -> npt.NDArray[np.int32]:
        """(h, w) int32 into `parts`, -1 for none. Raises ValueError where ids were not asked for."""
        if self.ids is None:
            raise ValueError("ask for ids=True")
        return np.where(self.ids < 0, -1, np.searchsorted(self.first_face, self.ids, side="right") - 1).astype(np.int32)

    @overload
    def save(self, file: File, depth: File | IO[bytes] | None = None, ids: File | IO[bytes] | None = None) -> Path: ...
    @overload
    def save(
        self, file: IO[bytes], depth: File | IO[bytes] | None = None, ids: File | IO[bytes] | None = None
    ) -> None: ...
    def save(self, file: Any, depth: Any = None, ids: Any = None) -> Path | None:
        """Write the picture as PNG, and its maps if they are named, all or none. `hlr/writers/PNG.md` describes them.

        Each is a path, or a file object that is open for bytes. Returns the picture's path, or None for a file object.
        Raises WriteError where a file cannot be written, or a map that was not asked for is to be.
        """
        return write_picture(self, file, depth, ids)

    def _repr_png_(self) -> bytes:
        """For notebooks: the PNG."""
        return PICTURE.render(self)
