"""Text that DXF takes: without control characters, and not too long."""

from __future__ import annotations

import re
from itertools import accumulate

MOST = 255
"""Bytes of a text."""

# What ends a line ends a value. Characters beyond 16 bits have no place in R12.
FORBIDDEN = re.compile("[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff\U00010000-\U0010ffff]")


def clean(text: str, most: int = MOST) -> str:
    """The text without what DXF cannot hold, cut where it is longer than `most` bytes however it is encoded."""
    text = FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
    # R12 writes seven bytes for a character that its code page has not.
    length = accumulate(1 if character < "\x7f" else 7 for character in text)
    return text[: sum(1 for taken in length if taken <= most)]
