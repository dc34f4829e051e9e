"""SVG: real millimetres, one group per visibility, line class and part, the edge on every path.

Visibilities and line classes are layers in Inkscape; where the style has the layers by part, parts are the outermost.
Widths, colours and dashes are presentation attributes on the groups. They work in every program that reads SVG, and any
CSS rule overrides them, because they rank below all selectors:

    #hidden { display: none }
    #visible .outline { stroke-width: .7 }
    [data-part="3"] { stroke: crimson }

With layers by part there are many hidden groups, which have the class `hidden` and no id. The background is that of the
root element, so it is nothing that a cutter would cut.

Coordinates are those of the drawing in millimetres with y turned down, so x and -y of a path are the `points` of the
exchange format.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import cast

from hlr.drawing.drawing import Drawing
from hlr.drawing.lines import held
from hlr.drawing.pens import Pen, PenSet, part_color
from hlr.drawing.scale import ratio
from hlr.drawing.sheet import SheetView
from hlr.drawing.underlay import underlay
from hlr.errors import counted
from hlr.request.directions import NAMED, axes, directed
from hlr.request.options import View
from hlr.writers.number import number
from hlr.writers.strokes import Inked, Strokes, strokes

# Characters that XML 1.0 cannot carry, escaped or not.
_SPECIAL = re.compile("[^ -~]|[&<>\"']")
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")

EQUAL = 1e-6
"""Difference of two unit vectors that counts as none."""


def svg(drawing: Drawing) -> bytes:
    """The drawing as an SVG file. Raises WriteError where a point is not finite."""
    page = strokes(drawing)
    width, height = number(page.width, page.side_places), number(page.height, page.side_places)
    corner = f"{number(page.left, page.places)} {number(-page.bottom - page.height, page.places)}"
    background = drawing.style.background
    root = {"stroke": "#000000", "stroke-linecap": "round"}
    paper = "" if background is None else f' style="background:{background}"'
    out = [
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<svg xmlns="http://www.w3.org/2000/svg" '
        'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="{width}mm" height="{height}mm" viewBox="{corner} {width} {height}" fill="none" '
        f'{_attributes(root)} stroke-linejoin="round"{paper}>\n',
        f"<title>{escaped(title(drawing))}</title>\n",
        f"<desc>{escaped(description(drawing))}</desc>\n",
        _metadata(drawing),
        template(underlay(drawing), page),
    ]
    if drawing.fill is not None:
        from hlr.writers.fill import painted, svg_group

        out.extend(svg_group(painted(drawing, drawing.fill), page.places))
    text = ["".join(out).encode("utf-8")]
    if drawing.style.layers == "class":
        text += _lines(page.inked, root, page.usual, ids=True)
    else:
        for pens, of_part in groupby(page.inked, lambda inked: inked.pens):
            (index,) = pens.parts
            label = _layer(f"part-{index}", drawing.parts[index].name)
            text.append(f'<g data-part="{index}" {label}>\n'.encode())
            text += [*_lines(of_part, root, pens, ids=False), b"</g>\n"]
    text.append(b"</svg>\n")
    return b"".join(text)


def template(content: str, page: Strokes) -> str:
    """What the page has printed on it, in the place of the drawing's coordinates; without the root's strokes."""
    if not content:
        return ""
    corner = f"{number(page.left, page.places)} {number(-page.bottom - page.height, page.places)}"
    plain = 'fill="#000000" stroke="none" stroke-width="1" stroke-linecap="butt" stroke-linejoin="miter"'
    return f'<g id="template" {_layer(None, "Template")} transform="translate({corner})" {plain}>\n{content}</g>\n'


Attributes = dict[str, str]


def _lines(inked: Iterable[Inked], root: Attributes, pens: PenSet, ids: bool) -> Iterator[bytes]:
    """The groups of hidden and visible lines.

    root: what holds around them. pens: those of most parts, which the groups state. ids: each has its id as well.
    """
    for visible, of_visibility in groupby(inked, lambda each: each.visible):
        name = "visible" if visible else "hidden"
        usual = _ink(pens.pen(None, visible))
        own_id = f'id="{name}" ' if ids else ""
        yield f'<g {own_id}class="{name}" {_layer(None, name.title())}{_changed(usual, root)}>\n'.encode()
        for row, of_class in groupby(of_visibility, lambda each: each.row):
            first = _ink(pens.pen(row.name, visible))
            label = _layer(None, f"{name.title()} {row.name}")
            yield f'<g class="{row.name}" {label}{_changed(first, usual)}>\n'.encode()
            for one in of_class:
                # Parts with pens of their own: the class once more, so that a rule for it holds for them too.
                changed = _changed(_ink(one.pen), first)
                yield f'<g class="{row.name}"{changed}>\n'.encode() if changed else b""
                yield one.svg()
                yield b"</g>\n" if changed else b""
            yield b"</g>\n"
        yield b"</g>\n"


def _ink(pen: Pen) -> Attributes:
    return {"stroke": pen.color, "stroke-width": number(pen.width), "stroke-linecap": pen.cap}


def _changed(own: Attributes, around: Attributes) -> str:
    """The attributes that differ from those of the group around."""
    if own == around:
        return ""
    changed = {name: value for name, value in own.items() if around.get(name) != value}
    return f" {_attributes(changed)}" if changed else ""


def _attributes(values: Attributes) -> str:
    return " ".join([f'{name}="{value}"' for name, value in values.items()])


def _layer(name: str | None, label: str) -> str:
    """What makes a group a layer in Inkscape."""
    own = "" if name is None else f'id="{name}" '
    return f'{own}inkscape:groupmode="layer" inkscape:label={_quoted(label)}'


def title(drawing: Drawing) -> str:
    """What the drawing shows, in one line: "motor.step, iso, 1:2"."""
    return f"{drawing.source}, {drawing.view.name}, {ratio(drawing.scale)}"


def description(drawing: Drawing) -> str:
    """What a reader who does not see the drawing is told."""
    visible, _ = held(drawing.lines).counts(0)
    cut = "" if drawing.section is None else ", cut by a plane"
    cut += " that steps" if drawing.section is not None and drawing.section.corners else ""
    hidden = len(drawing.lines) - visible
    return (
        f"Hidden-line drawing of {drawing.source}{cut}: view {drawing.view.name}, {drawing.view.projection}, scale "
        f"{ratio(drawing.scale)}, {counted(visible, 'visible line')} and {counted(hidden, 'hidden line')}."
    )


def _metadata(drawing: Drawing) -> str:
    """The element that leads from a path back to the model: view, scale, origin, unit and parts; or views and parts."""
    named = {"source": drawing.source, "view": drawing.view.name}
    fields = {**(_camera(drawing) if drawing.sheet is None else {}), **accuracies(drawing)}
    attributes = " ".join(
        [
            *[f"{key}={_quoted(value)}" for key, value in named.items()],
            *[f'{key}="{value}"' for key, value in fields.items()],
        ]
    )
    views = "" if drawing.sheet is None else "".join(map(_view, drawing.sheet.views))
    parts = []
    for index, part in enumerate(drawing.parts):
        own = part_color(part)
        color = "" if own is None else f' color="{own}"'
        parts.append(f'<part index="{index}" name={_quoted(part.name)}{color}/>\n')
    errors = _attributes(reached(drawing))
    measured = f"<reached {errors}/>\n" if errors else ""
    inside = measured + views + "".join(parts)
    return f'<metadata>\n<drawing xmlns="urn:hlr:drawing:1" {attributes}>\n{inside}</drawing>\n</metadata>\n'


def stated_view(drawing: Drawing) -> str:
    """What a PDF or DXF says of a view that its lines do not tell: a section, a window, perspective, any direction, or
    another up than the usual one.

    "view=front; direction=0 -1 0; ...", as the metadata of an SVG; "views=4" of a page; empty: a whole view that has a
    name.
    """
    if drawing.sheet is not None:
        return f"views={len(drawing.sheet.views)}" if len(drawing.sheet.views) > 1 else ""
    view = drawing.view
    whole = drawing.section is None and drawing.window is None and view.eye is None
    if whole and view.name in NAMED and _has_usual_up(drawing):
        return ""
    return "; ".join(f"{key}={value}" for key, value in {"view": view.name, **_camera(drawing)}.items())


def _has_usual_up(drawing: Drawing) -> bool:
    """Whether a view that has a name shows up what it usually does."""
    _, direction, named_up = directed(cast(View, drawing.view.name))
    up = [sum(a * b for a, b in zip(row, drawing.view.up, strict=True)) for row in drawing.up_axis]
    return all(abs(a - b) < EQUAL for a, b in zip(up, axes(direction, named_up)[1], strict=True))


def _camera(drawing: Drawing) -> dict[str, str]:
    """How the model was seen."""
    view = drawing.view
    fields = {
        "projection": view.projection,
        "direction": _vector(view.direction),
        "right": _vector(view.right),
        "up": _vector(view.up),
    }
    if view.eye is not None:
        fields["eye"] = _vector(view.eye)
    if view.target is not None:
        fields["target"] = _vector(view.target)
    if drawing.section is not None:
        fields["section"] = _vector(drawing.section.point)
        if drawing.section.corners:
            fields["section-corners"] = _vector(tuple(c for corner in drawing.section.corners for c in corner))
    if drawing.window is not None:
        fields["window"] = _vector(drawing.window)
    return fields | {"scale": ratio(drawing.scale), "origin": _vector(drawing.origin), "unit": f"{drawing.unit:.9g}"}


def _view(view: SheetView) -> str:
    """A view of a page."""
    vectors: dict[str, Sequence[float] | None] = {
        "place": view.place,
        "origin": view.origin,
        "direction": view.direction,
        "right": view.right,
        "plane": view.section,
        "plane-corners": [c for corner in view.corners for c in corner] or None,
    }
    fields = " ".join(f'{key}="{_vector(value)}"' for key, value in vectors.items() if value is not None)
    cut = f' section="{view.letter}-{view.letter}"' if view.letter else ""
    return (
        f'<view name={_quoted(view.name)} label={_quoted(view.label)} scale="{ratio(view.scale)}" '
        f'rotation="{view.rotation + 0.0:.9g}" {fields}{cut}/>\n'
    )


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


def _vector(values: Sequence[float]) -> str:
    return " ".join([f"{value + 0.0:.9g}" for value in values])


def _clean(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)


def escaped(text: str) -> str:
    """Text between tags. What `xml.sax.saxutils` does, without the network that it loads."""
    return _clean(text).replace("&", "&amp;").replace(">", "&gt;").replace("<", "&lt;")


def _quoted(text: str) -> str:
    """The value of an attribute, with its quotes."""
    if _SPECIAL.search(text) is None:
        return f'"{text}"'
    value = escaped(text).replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")
    if '"' not in value:
        return f'"{value}"'
    return f"'{value}'" if "'" not in value else '"' + value.replace('"', "&quot;") + '"'
