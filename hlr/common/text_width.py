"""How wide a text is in Helvetica, the font of PDF that needs no file."""

from __future__ import annotations


def text_width(text: str) -> float:
    """In sizes of the font; a character that is not in its table counts as a digit."""
    return sum(_WIDTHS.get(letter, 556) for letter in text) / 1000.0


_PRINTED = (
    *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556),
    *(1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778),
    *(667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556),
    *(333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556),
    *(556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584),
)
_WIDTHS = {chr(32 + i): width for i, width in enumerate(_PRINTED)}
"""Widths of Helvetica's characters, thousandths of its size."""
