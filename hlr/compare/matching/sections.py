"""Which section of a page is which of another: those of one view have lines of their own, whatever they are called."""

from __future__ import annotations

import re
from collections.abc import Sequence

from hlr.compare.lines.pieces import Pieces
from hlr.compare.matching.hatched_areas import Hatches, by_part, without_hatches
from hlr.compare.matching.register import translation

_FURTHER = re.compile(r"(.+)-[A-Z][0-9]*")
"""The name of a section of a view that has others: front-B."""

_SEVERAL = 2
"""Sections of one view."""

_DIGITS = 3
"""Of shares of length: sections that are more alike are told apart by their names."""


def base_of(name: str) -> str:
    """The view that a section is one of: front of front-B, and of front."""
    found = _FURTHER.fullmatch(name)
    return found[1] if found else name


def sections_of(base: str, names: Sequence[str]) -> list[int]:
    """The numbers of all that is drawn of a view among views of these names; empty where the view itself is not."""
    return [number for number, name in enumerate(names) if base_of(name) == base] if base in names else []


def likeness(one: Pieces, other: Pieces, tolerance_mm: float) -> float:
    """Which share of the lines of each, at least, lies on the other where they fit best; of hatches, in its areas."""
    return round(min(_share(one, other, tolerance_mm), _share(other, one, tolerance_mm)), _DIGITS)


def _share(one: Pieces, other: Pieces, tolerance_mm: float) -> float:
    """Which share of the lines of the first lies on the second."""
    edges, others = without_hatches(one, other)
    shift, share = translation(edges, others, tolerance_mm, search=False)
    if len(edges) == len(one):
        return share
    hatches = Hatches.of(by_part(one.shifted(shift)))
    inside = float(hatches.divided(Hatches.of(by_part(other)), tolerance_mm)[0].lengths.sum())
    lengths = float(edges.lengths.sum()), float(hatches.pieces.lengths.sum())
    return (share * lengths[0] + inside) / sum(lengths)


def paired_sections(
    one: tuple[Sequence[str], Pieces], other: tuple[Sequence[str], Pieces], tolerance_mm: float
) -> dict[int, int]:
    """Sections of one page by those of another, those first that are most alike; where names say it, nothing.

    one, other: the names of the views, and all lines
    """
    found: dict[int, int] = {}
    for base in dict.fromkeys(map(base_of, one[0])):
        ours, theirs = sections_of(base, one[0]), sections_of(base, other[0])
        if max(len(ours), len(theirs)) < _SEVERAL or not ours or not theirs:
            continue
        parts = [
            [lines.take(lines.view == k) for k in numbers] for numbers, (_, lines) in ((ours, one), (theirs, other))
        ]
        ranked = [
            (-likeness(a, b, tolerance_mm), one[0][i] != other[0][j], i, j)
            for i, a in zip(ours, parts[0], strict=True)
            for j, b in zip(theirs, parts[1], strict=True)
        ]
        for _, _, i, j in sorted(ranked):
            if i not in found and j not in found.values():
                found[i] = j
    return found
