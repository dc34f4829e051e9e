"""A trace for teaching and debugging: pixels and edges outlined, the writes in their order, the result; as SVG."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hlr.image.camera import Camera
from hlr.lab.methods.areas import Area
from hlr.lab.methods.polygons import polygons_of
from hlr.lab.methods.render import render
from hlr.lab.methods.viewport import Screen

PIXEL = 24
"""Size of a pixel in the trace."""

COLOURS = ("#88b7e3", "#f4b183", "#a9d18e", "#ffd966", "#c5a5d9", "#9fd5d1", "#e79a9a", "#c9c9c9")


def trace_svg(
    scene: Any, camera: Camera | Screen, size: tuple[int, int], method: str = "z-buffer", **options: Any
) -> str:
    """An SVG of all writes of a method, numbered in order, beside the resulting picture; options as in `render`.

    For Warnock's subdivision its areas are outlined as well, each with the letter of its ending
    (`hlr.lab.methods.Area`).
    """
    polygons = polygons_of(scene, options.get("rule", "even-odd"), options.get("cull", False))
    found = render(polygons, camera, size, method, trace=True, **options)
    assert found.trace is not None
    width, height = size
    wide, high = width * PIXEL, height * PIXEL
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-4 -20 {2 * wide + 32} {high + 28}" '
        f'font-family="sans-serif" font-size="{PIXEL // 3}">\n',
        f'<text x="0" y="-8">{method}: the writes in their order</text>',
        f'<text x="{wide + 24}" y="-8">the result</text>\n',
    ]
    out.append('<g class="writes">\n')
    seen: dict[tuple[int, int], int] = {}
    for number, (row, start, end, polygon) in enumerate(found.trace.tolist(), 1):
        out.append(_cell(start, row, end - start, polygon))
        # Later writes to a pixel stand below the earlier ones.
        line = seen[start, row] = seen.get((start, row), -1) + 1
        out.append(f'<text x="{start * PIXEL + 2}" y="{row * PIXEL + 8 + 7 * line}">{number}</text>\n')
    out.append("</g>\n")
    if found.areas:
        out.append(_outlined(found.areas))
    out.append(f'<g class="result" transform="translate({wide + 24} 0)">\n')
    for row, column in np.argwhere(found.ids >= 0).tolist():
        out.append(_cell(column, row, 1, int(found.ids[row, column])))
    out.append("</g>\n")
    edges = []
    matrix = np.asarray(found.viewport.matrix)
    flat = np.concatenate([polygons.points, np.ones((len(polygons.points), 1))], axis=1) @ matrix.T
    with np.errstate(divide="ignore", invalid="ignore"):
        pixels = flat[:, :2] / flat[:, 3:] * PIXEL
    for first, last in zip(polygons.loops[:-1], polygons.loops[1:], strict=True):
        corners = pixels[polygons.corners[first:last]]
        if np.isfinite(corners).all():
            edges.append("M" + " L".join(f"{x:.6g} {y:.6g}" for x, y in corners.tolist()) + "Z")
    grid = "".join(f"M{x * PIXEL} 0V{high}" for x in range(width + 1))
    grid += "".join(f"M0 {y * PIXEL}H{wide}" for y in range(height + 1))
    for shift in (0, wide + 24):
        out.append(f'<g transform="translate({shift} 0)" fill="none"><path class="pixels" stroke="#bbb" d="{grid}"/>')
        out.append(f'<path class="edges" stroke="#000" d="{" ".join(edges)}"/></g>\n')
    out.append("</svg>\n")
    return "".join(out)


def _outlined(areas: Sequence[Area]) -> str:
    """SVG of the areas, the larger ones with wider lines, and their endings in their lower right corners."""
    deepest = max(area.level for area in areas)
    out = ['<g class="areas" fill="none" stroke="#c00">\n']
    for area in areas:
        (x0, x1), (y0, y1) = ((low * PIXEL, high * PIXEL) for low, high in (area.columns, area.rows))
        wide = 1.0 + 0.75 * (deepest - area.level)
        out.append(f'<rect x="{x0}" y="{y0}" width="{x1 - x0}" height="{y1 - y0}" stroke-width="{wide:g}"/>')
        if area.ending != "quartered":
            name = area.ending.removesuffix("ixel")
            out.append(f'<text x="{x1 - 3}" y="{y1 - 4}" text-anchor="end" fill="#c00" stroke="none">{name}</text>')
        out.append("\n")
    return "".join(out) + "</g>\n"


def _cell(column: int, row: int, columns: int, polygon: int) -> str:
    colour = COLOURS[polygon % len(COLOURS)]
    return (
        f'<rect x="{column * PIXEL}" y="{row * PIXEL}" width="{columns * PIXEL}" height="{PIXEL}" '
        f'fill="{colour}" fill-opacity=".7" data-id="{polygon}"/>\n'
    )
