"""Filled faces as SVG and PDF.

Each opaque face is also stroked in its own colour. Otherwise a viewer with anti-aliasing would show the paper between
two faces that share a border. Large faces come first, so that small ones keep their shape. Where two faces meet at an
angle, the drawing's own line is wider than the stroke.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby, pairwise

import numpy as np

from hlr.common.colors import hex_of, rgb_of
from hlr.common.distinct import distinct
from hlr.drawing.drawing import Drawing
from hlr.drawing.fill import Fill, Gradient
from hlr.drawing.pens import part_color
from hlr.errors import WriteError
from hlr.writers.number import NOT_FINITE, grid, number

SEAM = 0.2
"""Width of the stroke around a face, millimetres: three quarters of a pixel of a screen at 1:1."""

DEFAULT = "#b3bdc9"
"""Of parts whose model names no colour."""

Loops = list[list[tuple[str, str]]]


def painted(drawing: Drawing, fill: Fill) -> Fill:
    """The fill in the colours that the drawing's style asks for: shaded, or each part flat in its own.

    Flat colours are opaque. The shaded ones of a transparent part hold what is behind it, and are opaque where that is.
    """
    if drawing.style.part_colors != "fills":
        return fill
    own = [part_color(part) or DEFAULT for part in drawing.parts]
    flat = np.array([rgb_of(color) for color in own], np.uint8).reshape(-1, 3)[fill.part]
    colors = np.concatenate([flat, np.full((len(flat), 1), 255, np.uint8)], axis=1)
    return replace(fill, colors=colors, gradient=np.full_like(fill.gradient, -1), gradients=())


def faces(fill: Fill, places: int) -> Iterator[tuple[int, Loops]]:
    """Each face that is left on the grid of so many decimals: its number, and its loops of x and y as text, y up."""
    if not np.isfinite(fill.points).all():
        raise WriteError(NOT_FINITE)
    unit = 10.0**-places
    steps = grid(fill.points, places)
    printed = {v: number(v * unit, places) for v in distinct(steps).tolist()}
    listed = steps.tolist()
    loops, starts = fill.loops.tolist(), fill.faces.tolist()
    for k in range(len(starts) - 1):
        drawn = []
        for start, end in zip(loops[starts[k] : starts[k + 1]], loops[starts[k] + 1 : starts[k + 1] + 1], strict=True):
            corners = listed[start:end]
            kept = [c for i, c in enumerate(corners) if c != corners[i - 1]]
            if len(kept) > 2:
                drawn.append([(printed[x], printed[y]) for x, y in kept])
        if drawn:
            yield k, drawn


def svg_group(fill: Fill, places: int) -> list[str]:
    """The group `#fill`; y is turned down."""
    out = [f'<g id="fill" fill-rule="evenodd" stroke-width="{number(SEAM)}">\n']
    if fill.gradients:
        out.append("<defs>\n")
        out.extend(_svg_gradient(k, gradient, places) for k, gradient in enumerate(fill.gradients))
        out.append("</defs>\n")
    flipped = replace(fill, points=fill.points * [1.0, -1.0])
    colors, gradient, parts = fill.colors.tolist(), fill.gradient.tolist(), fill.part.tolist()

    def paint(k: int) -> str:
        color = hex_of(colors[k]) if gradient[k] < 0 else f"url(#gradient-{gradient[k]})"
        opacity = colors[k][3]
        # Transparent faces have no stroke: where it overlapped the fill, they would be less transparent.
        rest = f' stroke="{color}"' if opacity == 255 else f' fill-opacity="{number(opacity / 255.0, 3)}" stroke="none"'
        return f'fill="{color}"{rest}'

    for own, group in groupby(faces(flipped, places), lambda face: paint(face[0])):
        out.append(f"<g {own}>\n")
        for k, loops in group:
            path = "".join("M" + "L".join(f"{x} {y}" for x, y in loop) + "Z" for loop in loops)
            out.append(f'<path d="{path}" data-part="{parts[k]}"/>\n')
        out.append("</g>\n")
    out.append("</g>\n")
    return out


def _svg_gradient(k: int, gradient: Gradient, places: int) -> str:
    x1, y1, x2, y2 = (
        number(float(v), places + 1) for v in (gradient.start[0], -gradient.start[1], gradient.end[0], -gradient.end[1])
    )
    stops = "".join(
        f'<stop offset="{number(share, 4)}" stop-color="{hex_of(color)}"/>'
        for share, color in zip(gradient.shares.tolist(), gradient.colors.tolist(), strict=True)
    )
    place = f'x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"'
    return f'<linearGradient id="gradient-{k}" gradientUnits="userSpaceOnUse" {place}>{stops}</linearGradient>\n'


def pdf_content(fill: Fill, places: int) -> bytes:
    """Fill and stroke, even-odd. Gradients are the patterns /G0, /G1, ..., opacities the states /O0 to /O255."""
    out = [f"{number(SEAM)} w 1 J [] 0 d\n"]
    colors, gradient = fill.colors.tolist(), fill.gradient.tolist()
    for k, loops in faces(fill, places):
        opaque = colors[k][3] == 255
        if gradient[k] >= 0:
            paint = f"/Pattern cs /G{gradient[k]} scn /Pattern CS /G{gradient[k]} SCN\n"
        else:
            shade = " ".join(number(c / 255.0, 4) for c in colors[k][:3])
            paint = f"{shade} rg {shade} RG\n"
        out.append(paint if opaque else f"q /O{colors[k][3]} gs\n{paint}")
        for loop in loops:
            out.append(" ".join(f"{x} {y} {'l' if j else 'm'}" for j, (x, y) in enumerate(loop)) + " h\n")
        out.append("B*\n" if opaque else "f*\nQ\n")
    return "".join(out).encode("ascii")


def pdf_resources(fill: Fill, matrix: tuple[float, ...]) -> dict[str, dict[str, str]]:
    """The patterns and states that `pdf_content` names. matrix: the six numbers from millimetres to the page."""
    place = " ".join(number(v, 9) for v in matrix)
    patterns = {
        f"G{k}": f"<< /PatternType 2 /Matrix [{place}] /Shading {_pdf_shading(gradient)} >>"
        for k, gradient in enumerate(fill.gradients)
    }
    through = sorted({int(c) for c in fill.colors[:, 3]} - {255})
    states = {f"O{c}": f"<< /ca {number(c / 255.0, 3)} >>" for c in through}
    return {name: held for name, held in (("Pattern", patterns), ("ExtGState", states)) if held}


def _pdf_shading(gradient: Gradient) -> str:
    at = " ".join(number(float(v), 5) for v in (*gradient.start, *gradient.end))
    shares = gradient.shares.tolist()
    colors = [" ".join(number(c / 255.0, 4) for c in color) for color in gradient.colors.tolist()]
    steps = [f"<< /FunctionType 2 /Domain [0 1] /C0 [{a}] /C1 [{b}] /N 1 >>" for a, b in pairwise(colors)]
    bounds = " ".join(number(s, 6) for s in shares[1:-1])
    encode = " ".join("0 1" for _ in steps)
    function = (
        f"<< /FunctionType 3 /Domain [0 1] /Functions [{' '.join(steps)}] /Bounds [{bounds}] /Encode [{encode}] >>"
    )
    return f"<< /ShadingType 2 /ColorSpace /DeviceRGB /Coords [{at}] /Function {function} /Extend [true true] >>"
