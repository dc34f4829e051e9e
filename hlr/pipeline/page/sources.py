"""What the views of a page show: objects of the document, and what sections leave of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hlr.drawing.notes import Note
from hlr.errors import SourceError
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import without_opencascade
from hlr.source.cad.occt_import import load_occt
from hlr.source.cad.parts import Leaf
from hlr.source.cad.source_builder import build_source
from hlr.source.freecad.fcstd import leaves_of
from hlr.source.freecad.page_views import Cut
from hlr.source.freecad.shapes import Shapes

if TYPE_CHECKING:
    from hlr.source.freecad.document import Document

Names = tuple[str, ...]


class Sources:
    """The objects that views show, opened once for all views of the same objects, and cut once for all details."""

    def __init__(self, document: Document, path: Path) -> None:
        self.name = path.name
        self._document, self._shapes = document, (Shapes(opencascade=False), Shapes(opencascade=True))
        self._opened: dict[tuple[Names, tuple[Cut, ...]], BrepSource | SourceError] = {}

    def of(self, names: Names, cuts: tuple[Cut, ...] = ()) -> BrepSource:
        """Raises SourceError where nothing of it can be drawn, or a section cannot be cut."""
        key = names, cuts
        if key not in self._opened:
            try:
                leaves, notes = (
                    self._cut(names, cuts) if cuts else without_opencascade(lambda o: self._leaves(names, o))
                )
                self._opened[key] = build_source(self.name, "fcstd", leaves, notes, wires_too=True)
            except SourceError as error:
                self._opened[key] = error
        found = self._opened[key]
        if isinstance(found, SourceError):
            raise found
        return found

    def _leaves(self, names: Names, opencascade: bool) -> tuple[list[Leaf], list[Note]]:
        return leaves_of(self._document, self.name, self._shapes[opencascade], only=names, sketches=True)

    def _cut(self, names: Names, cuts: tuple[Cut, ...]) -> tuple[list[Leaf], list[Note]]:
        from hlr.source.cad.half_space import cut_away

        load_occt()
        leaves, notes = self._leaves(names, True)
        for cut in cuts:
            leaves = cut_away(leaves, np.array(cut.origin), np.array(cut.normal))
        if not leaves:
            raise SourceError("its plane leaves nothing of the model.")
        return leaves, notes
