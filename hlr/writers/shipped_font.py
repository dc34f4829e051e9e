"""The font that comes with the package, for letters that Helvetica has not in PDF: what a page uses of it is embedded.

Where it comes from, and what it has: fonts/README.md. The same letters give the same bytes.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from hashlib import blake2b
from pathlib import Path
from types import MappingProxyType
from typing import Any

import pydyf
from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont

from hlr.writers.number import number

FILE = Path(__file__).parent / "fonts" / "DejaVuSans.ttf"

_NAME = "DejaVuSans"

_NOT_EMBEDDED = ("OS/2", "cmap", "name", "post")
"""Tables that no viewer reads of a font whose glyphs have numbers."""

_SYMBOLIC = 4
"""Flag of a font whose letters are not those of a standard encoding alone."""

_STEM = 90
"""Width of its upright strokes, thousandths of its size."""


@cache
def advances() -> Mapping[str, float]:
    """How far each letter of the font moves on, in sizes of the font."""
    font = _font()
    em, metrics = font["head"].unitsPerEm, font["hmtx"]
    return MappingProxyType({chr(code): metrics[name][0] / em for code, name in font.getBestCmap().items()})


def embedded(document: pydyf.PDF, used: Iterable[str]) -> Any:
    """Adds the font with these letters to a document: the reference to it. A letter has its code point as number."""

    def added(thing: Any) -> Any:
        document.add_object(thing)
        return thing.reference

    letters, font = sorted(used), _font()
    glyphs = [font.getBestCmap()[ord(letter)] for letter in letters]
    measures, data = _measures(font), _subset(font, glyphs)
    # A subset is told apart from others by six letters.
    digest = blake2b("".join(letters).encode("utf-16-be")).digest()
    name = "/" + "".join(chr(ord("A") + byte % 26) for byte in digest[:6]) + "+" + _NAME
    file = added(pydyf.Stream([data], {"Length1": len(data)}, compress=True))
    described = {"Type": "/FontDescriptor", "FontName": name, "Flags": _SYMBOLIC, **measures, "FontFile2": file}
    places = [font.getGlyphID(glyph) for glyph in glyphs]
    widths = advances()
    numbered = {
        "Type": "/Font",
        "Subtype": "/CIDFontType2",
        "BaseFont": name,
        "CIDSystemInfo": "<< /Registry (Adobe) /Ordering (Identity) /Supplement 0 >>",
        "FontDescriptor": added(pydyf.Dictionary(described)),
        "W": pydyf.Array(f"{ord(letter)} [{number(1000.0 * widths[letter], 3)}]" for letter in letters),
        "CIDToGIDMap": added(pydyf.Stream([_places(letters, places)], compress=True)),
    }
    whole = {
        "Type": "/Font",
        "Subtype": "/Type0",
        "BaseFont": name,
        "Encoding": "/Identity-H",
        "DescendantFonts": pydyf.Array([added(pydyf.Dictionary(numbered))]),
        "ToUnicode": added(pydyf.Stream([_to_unicode(letters)], compress=True)),
    }
    return added(pydyf.Dictionary(whole))


def _font() -> Any:
    return TTFont(FILE, recalcTimestamp=False, lazy=True)


def _measures(font: Any) -> dict[str, Any]:
    """What a viewer wants to know of a font, thousandths of its size."""
    head, per_mille = font["head"], 1000.0 / font["head"].unitsPerEm
    cap = font["glyf"][font.getBestCmap()[ord("H")]].yMax
    box = (head.xMin, head.yMin, head.xMax, head.yMax)
    heights = {"Ascent": font["hhea"].ascent, "Descent": font["hhea"].descent, "CapHeight": cap}
    return {
        "FontBBox": pydyf.Array(number(each * per_mille, 3) for each in box),
        "ItalicAngle": 0,
        **{name: number(height * per_mille, 3) for name, height in heights.items()},
        "StemV": _STEM,
    }


def _subset(font: Any, glyphs: Sequence[str]) -> bytes:
    """Cuts a font down to these glyphs: its file."""
    options = Options(recalc_timestamp=False, notdef_outline=True)
    options.drop_tables = [*options.drop_tables, *_NOT_EMBEDDED]
    subsetter = Subsetter(options)
    subsetter.populate(glyphs=glyphs)
    subsetter.subset(font)
    out = io.BytesIO()
    font.save(out)
    return out.getvalue()


def _places(letters: Sequence[str], places: Sequence[int]) -> bytes:
    """Two bytes for each code point up to the last one: the place of its glyph in the font."""
    table = bytearray(2 * (ord(letters[-1]) + 1))
    for letter, place in zip(letters, places, strict=True):
        table[2 * ord(letter) : 2 * ord(letter) + 2] = place.to_bytes(2, "big")
    return bytes(table)


def _to_unicode(letters: Sequence[str]) -> bytes:
    """The map by which viewers search and copy: each number is a letter."""
    lines = [
        "/CIDInit /ProcSet findresource begin 12 dict begin begincmap",
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def",
        "/CMapName /Adobe-Identity-UCS def /CMapType 2 def",
        "1 begincodespacerange <0000> <FFFF> endcodespacerange",
    ]
    # A block has at most 100 of them.
    for block in (letters[start : start + 100] for start in range(0, len(letters), 100)):
        told = (f"<{ord(letter):04X}> <{ord(letter):04X}>" for letter in block)
        lines += [f"{len(block)} beginbfchar", *told, "endbfchar"]
    lines.append("endcmap CMapName currentdict /CMap defineresource pop end end\n")
    return "\n".join(lines).encode("ascii")
