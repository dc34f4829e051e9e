"""A remark where a style has rules for parts that the model does not have."""

from __future__ import annotations

from collections.abc import Sequence

from hlr.drawing.drawing import DrawnPart
from hlr.drawing.notes import Note
from hlr.request.part_names import matches
from hlr.request.style import Style
from hlr.source.selection import suggestion

MAX_NAMED = 3
"""Patterns with a note of their own; one more note has the number of all others."""


def unused_rules(style: Style, parts: Sequence[DrawnPart]) -> list[Note]:
    """One note per pattern of a style that matches none of these parts, nor an assembly of one."""
    patterns = dict.fromkeys(rule.parts for rule in style.lines if rule.parts is not None)
    if not patterns:
        return []
    names = list(dict.fromkeys(name for part in parts for name in (part.name, *part.above)))
    unused = [pattern for pattern in patterns if not any(matches(name, pattern) for name in names)]
    texts = [
        f'the style\'s rule for parts "{pattern}" matches no part: {suggestion(pattern, names)}.'
        for pattern in unused[:MAX_NAMED]
    ]
    more = len(unused) - MAX_NAMED
    if more > 0:
        texts.append(f"{more} more of the style's rules for parts {'matches' if more == 1 else 'match'} no part.")
    return [Note("style-unused", text) for text in texts]
