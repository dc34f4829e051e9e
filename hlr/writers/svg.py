"""SVG: real millimetres, one group per visibility and line class, part and edge on every path.

Widths and dashes are presentation attributes on the groups. They work in every program that reads SVG, and any CSS
rule overrides them, because they rank below all selectors:

    #hidden { display: none }
    #visible .outline { stroke-width: .7 }
    [data-part="3"] { stroke: crimson }

Coordinates are those of the drawing in millimetres with y turned down, so x and -y of a path are the `points` of the
exchange format.
"""

from __future__ import annotations

import re
from itertools import groupby
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from hlr.drawing import Drawing
from hlr.writers import style
from hlr.writers.number import encode, number
from hlr.writers.strokes import Layer, strokes

# Characters that XML 1.0 cannot carry, escaped or not.
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def svg(drawing: Drawing) -> bytes:
    """The drawing as an SVG file. Raises WriteError where a point is not finite."""
    page = strokes(drawing)
    unit = 10.0**-page.places
    left, top = page.left * unit, -(page.bottom + page.height) * unit
    width, height = (number(v * unit, page.places) for v in (page.width, page.height))
    corner = f"{number(left, page.places)} {number(top, page.places)}"
    out = [
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="{corner} {width} {height}" fill="none" stroke="#000" '
        'stroke-linecap="round" stroke-linejoin="round">\n',
        f"<title>{escape(_clean(title(drawing)))}</title>\n",
        _metadata(drawing),
    ]
    for visible, layers in groupby(page.layers, lambda layer: layer.visible):
        out.append(_open_group(visible))
        for layer in layers:
            thin = f' stroke-width="{number(style.NARROW)}"' if layer.visible and _narrow(layer) else ""
            out.append(f'<g class="{layer.kind}"{thin}>\n')
            out.extend(_paths(layer, page.places))
            out.append("</g>\n")
        out.append("</g>\n")
    out.append("</svg>\n")
    return "".join(out).encode("utf-8")


def title(drawing: Drawing) -> str:
    """What the drawing shows, in one line: "motor.step, iso, 1:2"."""
    return f"{drawing.source}, {drawing.view.name}, {style.ratio(drawing.scale)}"


def _open_group(visible: bool) -> str:
    if visible:
        return f'<g id="visible" stroke-width="{number(style.WIDE)}">\n'
    pattern = " ".join(number(v) for v in style.dash(False) or ())
    # Round caps would lengthen each dash by the line width.
    return f'<g id="hidden" stroke-width="{number(style.NARROW)}" stroke-dasharray="{pattern}" stroke-linecap="butt">\n'


def _narrow(layer: Layer) -> bool:
    return style.width(layer.kind, layer.visible) == style.NARROW


def _paths(layer: Layer, places: int) -> list[str]:
    """One element per stroke."""
    text, offsets = _path_data(layer, places)
    out = []
    spans = zip(offsets[:-1], offsets[1:], layer.closed.tolist(), layer.part, layer.edge, layer.other, strict=True)
    for start, end, closed, part, edge, other in spans:
        tie = "" if edge is None else f' data-edge="{edge}"'
        tie += "" if other is None else f' data-other="{other}"'
        out.append(f'<path data-part="{part}"{tie} d="{text[start:end]}{"z" if closed else ""}"/>\n')
    return out


def _path_data(layer: Layer, places: int) -> tuple[str, list[int]]:
    """The `d` of all strokes in one text, and where each starts in it (s + 1 offsets).

    A stroke starts with an absolute M and goes on with relative h, v or l; the letter and the space are left out
    where the grammar allows it.
    """
    points = layer.points * np.array([1, -1])
    n = len(points)
    starts = layer.starts[:-1]
    head = np.zeros(n, np.bool_)
    head[starts] = True
    values = np.diff(points, axis=0, prepend=0)
    values[head] = points[head]

    # Two numbers per point, except where a relative one is zero.
    shown = (values != 0) | head[:, None]
    command = np.full(n, ord("l"), np.uint8)
    command[~shown[:, 1]] = ord("h")
    command[~shown[:, 0]] = ord("v")
    command[head] = ord("M")
    again = np.zeros(n, np.bool_)
    again[1:] = (command[1:] == command[:-1]) & ~head[1:]
    lead = np.zeros((n, 2), np.uint8)
    lead[:, 0] = np.where(again, 0, command)
    only_y = ~shown[:, 0]
    lead[only_y, 1] = lead[only_y, 0]

    flat, before = values[shown], lead[shown]
    whole = 10**places
    fraction = flat % whole != 0
    follows_fraction = np.concatenate([[False], fraction[:-1]])
    starts_with_dot = (np.abs(flat) < whole) & (flat != 0)
    apart = (before == 0) & (flat >= 0) & ~(starts_with_dot & follows_fraction)
    before[apart] = ord(" ")

    text, ends = encode(flat, places, before[:, None])
    first_number = np.concatenate([[0], np.cumsum(shown.sum(axis=1))])[layer.starts]
    return text.decode("ascii"), ends[first_number].tolist()


def _metadata(drawing: Drawing) -> str:
    """What is needed to go from a path back to the model."""
    view = drawing.view
    fields = {
        "source": drawing.source,
        "view": view.name,
        "projection": view.projection,
        "direction": _vector(view.direction),
        "right": _vector(view.right),
        "up": _vector(view.up),
    }
    if view.eye is not None:
        fields["eye"] = _vector(view.eye)
    fields |= {
        "scale": style.ratio(drawing.scale),
        "origin": _vector(drawing.origin),
        "unit": f"{drawing.unit:.9g}",
        "accuracy": f"{float(drawing.accuracy['used']):.6g}",
    }
    attributes = " ".join(f"{key}={quoteattr(_clean(value))}" for key, value in fields.items())
    parts = []
    for index, part in enumerate(drawing.parts):
        color = f' color="{_hex(part.color)}"' if part.color is not None else ""
        parts.append(f'<part index="{index}" name={quoteattr(_clean(part.name))}{color}/>\n')
    return f'<metadata>\n<drawing xmlns="urn:hlr:drawing:1" {attributes}>\n{"".join(parts)}</drawing>\n</metadata>\n'


def _vector(values: tuple[float, ...]) -> str:
    return " ".join(f"{value + 0.0:.9g}" for value in values)


def _hex(color: tuple[float, float, float]) -> str:
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, channel))):02x}" for channel in color)


def _clean(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
