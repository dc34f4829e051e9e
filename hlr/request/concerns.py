"""Options that are for some sources or formats only: a row each. Elsewhere they are allowed, and change nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from hlr.tables.readers import Reader, file_titles
from hlr.tables.writers import WRITERS


@dataclass(frozen=True, slots=True)
class OfSources:
    """A row: an option that is for what some readers open.

    whose     what it is for, in words
    fits      whether it is for what this reader opens
    somewhat  a B-rep may hold shapes that are made of triangles alone, which count as meshes
    """

    whose: str
    fits: Callable[[Reader], bool]
    somewhat: bool = False

    @property
    def but(self) -> str:
        """After "has no effect", where it is for others: on what it has."""
        return " but on shapes that are made of triangles alone" if self.somewhat else ""


def _of_readers(fits: Callable[[Reader], bool]) -> OfSources:
    return OfSources(file_titles(fits), fits)


_MESHES = OfSources("meshes", lambda reader: not reader.brep or reader.meshes, somewhat=True)
_CAD_MODELS = OfSources("CAD models", lambda reader: reader.brep)

OF_SOURCES: dict[str, OfSources] = {
    "crease": _MESHES,
    "circles": _MESHES,
    "smooth": _CAD_MODELS,
    "seam": _CAD_MODELS,
    "annotations": _of_readers(lambda reader: "annotations" in reader.takes),
    "hidden_objects": _of_readers(lambda reader: "hidden_objects" in reader.takes),
    "no_cache": _of_readers(lambda reader: reader.cached),
}
"""Options of a drawing, and of the command line, by name."""

OF_FORMATS: dict[str, tuple[str, ...]] = {
    "dpi": ("png", "json"),
    "size": ("png", "json"),
    "layers": tuple(name for name in WRITERS if name != "png"),
    "background": tuple(name for name in WRITERS if name != "dxf"),
}
"""Values of a style, and the formats that they are for. JSON holds the whole style, for files that are made of it."""
