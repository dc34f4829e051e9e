"""SVG: real millimetres, one group per visibility, line class and part, the edge on every path.

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

from hlr.drawing.drawing import Drawing
from hlr.drawing.scale import ratio
from hlr.tables.line_classes import by_number
from hlr.writers import style
from hlr.writers.number import number
from hlr.writers.strokes import strokes

# Characters that XML 1.0 cannot carry, escaped or not.
_SPECIAL = re.compile("[^ -~]|[&<>\"']")
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def svg(drawing: Drawing) -> bytes:
    """The drawing as an SVG file. Raises WriteError where a point is not finite."""
    page = strokes(drawing)
    width, height = (number(side, page.side_places) for side in (page.width, page.height))
    corner = f"{number(page.left, page.places)} {number(-page.bottom - page.height, page.places)}"
    out = [
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="{corner} {width} {height}" fill="none" stroke="#000" '
        'stroke-linecap="round" stroke-linejoin="round">\n',
        f"<title>{_escaped(title(drawing))}</title>\n",
        _metadata(drawing),
    ]
    if drawing.fill is not None:
        from hlr.writers.fill import svg_group

        out.extend(svg_group(drawing.fill, page.places))
    text = ["".join(out).encode("utf-8")]
    for visible, layers in groupby(page.layers, lambda layer: layer.visible):
        usual = style.group_width(visible)
        # Round caps would lengthen each dash by the line width.
        cap = "" if visible else ' stroke-linecap="butt"'
        name = "visible" if visible else "hidden"
        text.append(f'<g id="{name}" stroke-width="{number(usual)}"{cap}>\n'.encode("ascii"))
        for layer in layers:
            row = by_number()[layer.kind]
            wide = style.width(row, visible)
            own = "" if wide == usual else f' stroke-width="{number(wide)}"'
            text += [f'<g class="{row.name}"{own}>\n'.encode("ascii"), page.svg(layer), b"</g>\n"]
        text.append(b"</g>\n")
    text.append(b"</svg>\n")
    return b"".join(text)


def title(drawing: Drawing) -> str:
    """What the drawing shows, in one line: "motor.step, iso, 1:2"."""
    return f"{drawing.source}, {drawing.view.name}, {ratio(drawing.scale)}"


def _metadata(drawing: Drawing) -> str:
    """The element that leads from a path back to the model: view, scale, origin, unit and parts."""
    view = drawing.view
    named = {"source": drawing.source, "view": view.name}
    fields = {
        "projection": view.projection,
        "direction": _vector(view.direction),
        "right": _vector(view.right),
        "up": _vector(view.up),
    }
    if view.eye is not None:
        fields["eye"] = _vector(view.eye)
    fields |= {
        "scale": ratio(drawing.scale),
        "origin": _vector(drawing.origin),
        "unit": f"{drawing.unit:.9g}",
        **accuracies(drawing),
    }
    attributes = " ".join(
        [
            *(f"{key}={_quoted(value)}" for key, value in named.items()),
            *(f'{key}="{value}"' for key, value in fields.items()),
        ]
    )
    parts = []
    for index, part in enumerate(drawing.parts):
        color = f' color="{_hex(part.color)}"' if part.color is not None else ""
        parts.append(f'<part index="{index}" name={_quoted(part.name)}{color}/>\n')
    errors = " ".join(f'{key}="{value}"' for key, value in reached(drawing).items())
    measured = f"<reached {errors}/>\n" if errors else ""
    inside = measured + "".join(parts)
    return f'<metadata>\n<drawing xmlns="urn:hlr:drawing:1" {attributes}>\n{inside}</drawing>\n</metadata>\n'


def accuracies(drawing: Drawing) -> dict[str, str]:
    """The accuracy that was used and the one that was asked for, millimetres on paper."""
    asked = drawing.accuracy.asked
    used = drawing.accuracy.used
    return {"accuracy": f"{used:.6g}", "accuracy-asked": "default" if asked is None else f"{float(asked):.6g}"}


def reached(drawing: Drawing) -> dict[str, str]:
    """The measured errors, class by class, millimetres on paper; empty where none were measured."""
    if drawing.reached is None:
        return {}
    return {name: f"{value:.3g}" for name, value in drawing.reached.figures().items()}


def _vector(values: tuple[float, ...]) -> str:
    return " ".join(f"{value + 0.0:.9g}" for value in values)


def _hex(color: tuple[float, float, float]) -> str:
    return "#" + "".join(f"{round(255 * min(1.0, max(0.0, channel))):02x}" for channel in color)


def _clean(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)


def _escaped(text: str) -> str:
    """Text between tags. What `xml.sax.saxutils` does, without the network that it loads."""
    return _clean(text).replace("&", "&amp;").replace(">", "&gt;").replace("<", "&lt;")


def _quoted(text: str) -> str:
    """The value of an attribute, with its quotes."""
    if _SPECIAL.search(text) is None:
        return f'"{text}"'
    value = _escaped(text).replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")
    if '"' not in value:
        return f'"{value}"'
    return f"'{value}'" if "'" not in value else '"' + value.replace('"', "&quot;") + '"'
