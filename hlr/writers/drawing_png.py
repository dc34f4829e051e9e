"""PNG of a line drawing: its PDF page, made of pixels by PDFium.

Page, lines and layers are those of the PDF. A millimetre of paper is so many pixels, which the file states. The same
drawing gives the same bytes.
"""

from __future__ import annotations

from typing import Any

from hlr.common.colors import rgb_of
from hlr.common.numbers import typed
from hlr.drawing.drawing import Drawing
from hlr.errors import WriteError
from hlr.request.defaults import DPI
from hlr.request.style_check import MOST_PIXELS, MOST_PIXELS_A_SIDE
from hlr.writers.pdf import Sheet, document
from hlr.writers.png import MM_PER_INCH, encoded
from hlr.writers.strokes import Strokes, strokes


def drawing_png(drawing: Drawing) -> bytes:
    """The drawing as a PNG file. Raises WriteError where a point is not finite, or for too many pixels."""
    page = strokes(drawing, cubic=True)
    sheet = _sheet(drawing, page)
    pixels = _rendered(document(drawing, page, sheet), drawing.style.background)
    told = {"Source": drawing.source, "View": drawing.view.name, "Scale": f"{drawing.scale:.9g}"}
    return encoded(pixels, told, sheet.factor * MM_PER_INCH)


def _sheet(drawing: Drawing, page: Strokes) -> Sheet:
    """The page in pixels: in the size that the style asks for, in the middle of it, or at its resolution."""
    style, width, height = drawing.style, page.width, page.height
    if style.size is None:
        factor = (style.dpi or DPI) / MM_PER_INCH
        wide, high = max(1, round(width * factor)), max(1, round(height * factor))
    else:
        wide, high = style.size
        factor = min(wide / width, high / height)
    if wide * high > MOST_PIXELS or max(wide, high) > MOST_PIXELS_A_SIDE:
        raise WriteError(
            f"a page of {typed(width)} x {typed(height)} mm would be {wide} x {high} pixels, more than {MOST_PIXELS:,} "
            f"or {MOST_PIXELS_A_SIDE} on a side: give fewer dpi, a size in pixels, or a smaller scale"
        )
    return Sheet(wide, high, factor, 0.5 * (wide - width * factor), 0.5 * (high - height * factor))


def _rendered(data: bytes, background: str | None) -> Any:
    """The only page of a PDF, a unit a pixel, as an image of Pillow."""
    try:
        import pypdfium2
    except ImportError:
        raise WriteError("PNG of a drawing needs pypdfium2: pip install pypdfium2") from None
    file = pypdfium2.PdfDocument(data)
    try:
        ground = (0, 0, 0, 0) if background is None else (*rgb_of(background), 255)
        return file[0].render(fill_color=ground, rev_byteorder=True).to_pil()
    finally:
        file.close()
