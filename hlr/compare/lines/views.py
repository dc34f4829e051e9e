"""Which view of a page the parts of a drawing of hlr belong to: the name of a part begins with that of its view."""

from __future__ import annotations

from collections.abc import Sequence


def views_of_parts(parts: Sequence[str], views: Sequence[str]) -> list[int]:
    """Of each part the number of its view; -1: none."""
    numbers = {name: number for number, name in enumerate(views)}
    return [numbers.get(part.partition("/")[0], -1) for part in parts]
