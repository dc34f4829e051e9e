"""The fonts of a page's texts in PDF: Helvetica, which every viewer has, and a font of the package for other letters.

A text that Helvetica has not all letters of is set whole in the other font. A letter that neither has becomes a
question mark.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass, field
from typing import Any

from hlr.common.text_width import text_width

HELVETICA, SHIPPED = "T", "U"
"""The names of the fonts among the resources of the page."""

ENCODING = "cp1252"
"""The letters that Helvetica has here, as Python calls them: WinAnsiEncoding."""

HELVETICA_RESOURCE = "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>"


@dataclass(frozen=True, slots=True)
class SetText:
    """A text in its font. font: its name among the resources; data: the codes of the letters; width: in sizes of the
    font."""

    font: str
    data: bytes
    width: float


@dataclass(slots=True)
class PageFonts:
    """The fonts of one page. used: the letters that were set in the font of the package."""

    used: set[str] = field(default_factory=set)

    def set_text(self, text: str) -> SetText:
        """A line of text, white space collapsed, in the font that has its letters."""
        words = _settled(text)
        if not _in_helvetica(words):
            from hlr.writers.shipped_font import advances

            widths = advances()
            has = "".join(letter if letter in widths or _in_helvetica(letter) else "?" for letter in words)
            if not _in_helvetica(has):
                has = "".join(letter if letter in widths else "?" for letter in has)
                self.used.update(has)
                # Each letter has the number of its code point: see `shipped_font.embedded`.
                return SetText(SHIPPED, has.encode("utf-16-be"), sum(widths[letter] for letter in has))
        return SetText(HELVETICA, words.encode(ENCODING, "replace"), text_width(words))

    def resources(self, document: Any) -> dict[str, Any]:
        """The fonts by their names. document: of pydyf; it gets the font of the package if a text is set in it."""
        fonts = {HELVETICA: HELVETICA_RESOURCE}
        if self.used:
            from hlr.writers.shipped_font import embedded

            fonts[SHIPPED] = embedded(document, self.used)
        return fonts


def missing_letters(text: str) -> list[str]:
    """The letters of a text that neither font has, each once."""
    letters = [letter for letter in dict.fromkeys(_settled(text)) if not _in_helvetica(letter)]
    if not letters:
        return []
    from hlr.writers.shipped_font import advances

    widths = advances()
    return [letter for letter in letters if letter not in widths]


def _settled(text: str) -> str:
    """With one space for white space, and letters with accents as one where Unicode has them."""
    return unicodedata.normalize("NFC", " ".join(text.split()))


def _in_helvetica(text: str) -> bool:
    return len(text.encode(ENCODING, "ignore")) == len(text)
