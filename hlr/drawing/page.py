"""The page that a drawing lies on."""

from __future__ import annotations

from dataclasses import dataclass

from hlr.drawing.line import Bounds


@dataclass(frozen=True, slots=True)
class Page:
    """A page, and where the drawing lies on it.

    name           of the sheet, such as "A4"; of a page without a name its size, such as "300x200"
    width, height  of the page, millimetres
    left, bottom   millimetres from the page's lower left corner to the drawing's, which is 0, 0 in its coordinates

    >>> import hlr
    >>> page = hlr.draw("part.step", view="top").page
    >>> page.name, page.width, page.height
    ('A4', 297.0, 210.0)
    >>> page.left, page.bottom
    (73.5, 55.0)
    """

    name: str
    width: float
    height: float
    left: float
    bottom: float

    @property
    def bounds(self) -> Bounds:
        """The page in the drawing's coordinates."""
        return Bounds(-self.left, -self.bottom, self.width - self.left, self.height - self.bottom)


def centred(name: str, width: float, height: float, drawn: Bounds) -> Page:
    """A page with what is drawn in its middle."""
    left = 0.5 * (width - drawn.width) - drawn.x0
    bottom = 0.5 * (height - drawn.height) - drawn.y0
    return Page(name, width, height, left, bottom)
