"""The overlay as SVG: a group for each kind of difference, so that a page can switch it on and off."""

from __future__ import annotations

from hlr.compare.lines.pieces import Floats
from hlr.compare.overlay.picture import PAPER, Overlay, Stroke, Text
from hlr.writers.number import number
from hlr.writers.svg import escaped


def svg(page: Overlay) -> str:
    """The text of the file."""
    width, height = number(page.width, 3), number(page.height, 3)
    out = [
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="0 0 {width} {height}" fill="none" stroke-linecap="round" stroke-linejoin="round" '
        f'font-family="sans-serif" style="background:{PAPER}">\n<title>{escaped(page.title)}</title>\n'
    ]
    out.extend(_stroke(mark) if isinstance(mark, Stroke) else _text(mark) for mark in page.marks)
    out.append("</svg>\n")
    return "".join(out)


def drawn_alone(page: Overlay) -> str:
    """The element without the legend, for a page that has one of its own."""
    strokes = "".join(_stroke(mark) for mark in page.marks if isinstance(mark, Stroke) and mark.name)
    width, height = number(page.width, 3), number(page.drawn, 3)
    return (
        f'<svg width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}" fill="none" '
        f'stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">\n{strokes}</svg>'
    )


def class_of(name: str) -> str:
    """The class of a mark of this name."""
    return name.replace(", ", " ").replace(" ", "-")


def _stroke(mark: Stroke) -> str:
    dash = ' stroke-dasharray="2 1.2"' if mark.dashed else ""
    names = " ".join(class_of(name) for name in (mark.name, mark.verdict) if name)
    name = f' class="{names}"' if names else ""
    path = "".join(map(_path, mark.lines))
    return f'<path{name} stroke="{mark.color}" stroke-width="{number(mark.width, 3)}"{dash} d="{path}"/>\n'


def _path(points: Floats) -> str:
    first, *rest = [f"{number(x, 3)} {number(y, 3)}" for x, y in points.tolist()]
    return f"M{first}L{' '.join(rest)}"


def _text(mark: Text) -> str:
    x, y = (number(each, 3) for each in mark.at)
    return f'<text x="{x}" y="{y}" font-size="{number(mark.size, 3)}" fill="{mark.color}">{escaped(mark.text)}</text>\n'
