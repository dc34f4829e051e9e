"""Filled faces as path data, for SVG and PDF alike: runs of one colour, far to near.

Each face is stroked in its own colour as well: between two faces that share an edge, a program that smooths edges would
else let the paper shine through.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from hlr.drawing import Fill
from hlr.errors import WriteError
from hlr.writers import number

SEAM = 0.1
"""Width of the stroke around a face, millimetres."""

Color = tuple[int, int, int]


def runs(fill: Fill, places: int) -> Iterator[tuple[Color, list[tuple[int, list[list[tuple[str, str]]]]]]]:
    """Faces of one colour that follow one another: (colour, [(part, loops of x and y as text)]), y up."""
    if not np.isfinite(fill.points).all():
        raise WriteError(number.NOT_FINITE)
    unit = 10.0**-places
    grid = number.grid(fill.points, places)
    printed = {v: number.number(v * unit, places) for v in np.unique(grid).tolist()}
    listed = grid.tolist()
    loops, faces, part = fill.loops.tolist(), fill.faces.tolist(), fill.part.tolist()
    colors: list[Color] = [(r, g, b) for r, g, b in fill.colors.tolist()]
    for color, group in groupby(range(len(part)), key=colors.__getitem__):
        out = []
        for k in group:
            drawn = []
            for start, end in zip(loops[faces[k] : faces[k + 1]], loops[faces[k] + 1 : faces[k + 1] + 1], strict=True):
                corners = listed[start:end]
                kept = [c for i, c in enumerate(corners) if c != corners[i - 1]]
                if len(kept) > 2:
                    drawn.append([(printed[x], printed[y]) for x, y in kept])
            if drawn:
                out.append((part[k], drawn))
        if out:
            yield color, out


def svg_group(fill: Fill, places: int) -> list[str]:
    """The group `#fill`; y is turned down."""
    out = [f'<g id="fill" fill-rule="evenodd" stroke-width="{number.number(SEAM)}">\n']
    for (red, green, blue), faces in runs(_flipped(fill), places):
        color = f"#{red:02x}{green:02x}{blue:02x}"
        out.append(f'<g fill="{color}" stroke="{color}">\n')
        for part, loops in faces:
            path = "".join("M" + "L".join(f"{x} {y}" for x, y in loop) + "Z" for loop in loops)
            out.append(f'<path d="{path}" data-part="{part}"/>\n')
        out.append("</g>\n")
    out.append("</g>\n")
    return out


def pdf_content(fill: Fill, places: int) -> bytes:
    """Fill and stroke, even-odd."""
    out = [f"{number.number(SEAM)} w 1 J [] 0 d\n"]
    for color, faces in runs(fill, places):
        shade = " ".join(number.number(c / 255.0, 4) for c in color)
        out.append(f"{shade} rg {shade} RG\n")
        for _, loops in faces:
            for loop in loops:
                out.append(" ".join(f"{x} {y} {'l' if k else 'm'}" for k, (x, y) in enumerate(loop)) + " h\n")
            out.append("B*\n")
    # Lines are black.
    out.append("0 g 0 G\n")
    return "".join(out).encode("ascii")


def _flipped(fill: Fill) -> Fill:
    return Fill(fill.points * [1.0, -1.0], fill.loops, fill.faces, fill.colors, fill.part)
