"""How entities of a DXF file look: their layers and linetypes, and what those say of a line being visible."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any

from hlr.compare.reading.dashes import HIDDEN, UNKNOWN, VISIBLE, by_dashes

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

HIDDEN_WORDS = {"hidden", "invisible", "verdeckt", "unsichtbar", "caché", "oculta", "nascosto"}
VISIBLE_WORDS = {"visible", "sichtbar"}
"""In names of layers, by themselves: a view may be called FrontHidden."""


class Looks:
    """The layers and linetypes of a document."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self.millimetres = _millimetres(document)
        self.off = cache(self._off)
        self.seen = cache(self._seen)

    def of(self, entity: Any, layer: str, linetype: str) -> tuple[str, str]:
        """Layer and linetype of an entity; layer, linetype: those of the block that it is in."""
        own = str(entity.dxf.get("layer", "0"))
        dashes = str(entity.dxf.get("linetype", "BYLAYER"))
        own = layer if own == "0" else own
        if dashes.upper() == "BYBLOCK":
            return own, linetype
        if dashes.upper() == "BYLAYER":
            return own, self._of_layer(own)
        return own, dashes

    def _of_layer(self, name: str) -> str:
        layers = self._document.layers
        return str(layers.get(name).dxf.get("linetype", "CONTINUOUS")) if layers.has_entry(name) else "CONTINUOUS"

    def _off(self, name: str) -> bool:
        """Whether a layer is not shown."""
        layers = self._document.layers
        return bool(layers.has_entry(name) and (layers.get(name).is_off() or layers.get(name).is_frozen()))

    def _seen(self, layer: str, linetype: str) -> int:
        """What layer and linetype say of a line: one of the four numbers above."""
        by_dashes = self._by_dashes(linetype)
        if by_dashes != UNKNOWN:
            return by_dashes
        words = set(re.split(r"[\W_]+", layer.lower()))
        if words & HIDDEN_WORDS:
            return HIDDEN
        return VISIBLE if words & VISIBLE_WORDS else UNKNOWN

    def _by_dashes(self, linetype: str) -> int:
        types = self._document.linetypes
        if not types.has_entry(linetype):
            return HIDDEN if linetype.upper().startswith(("HIDDEN", "DASHED")) else UNKNOWN
        tags = types.get(linetype).pattern_tags.tags
        return by_dashes(tag.value for tag in tags if tag.code == 49 and tag.value >= 0.0)


def _millimetres(document: Document) -> float:
    """Of one unit of the file; 1 where it says nothing."""
    from ezdxf import units

    unit = document.units
    return float(units.conversion_factor(unit, units.MM)) if 0 < unit <= 24 else 1.0
