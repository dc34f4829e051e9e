"""A page with a template; and a PDF looked at: its commands, and its page as pixels."""

import zlib
from dataclasses import replace

import numpy as np
import pypdfium2

from hlr.drawing.page import Page
from hlr.drawing.sheet import Sheet
from hlr.writers.pdf import pdf
from support.drawings import drawing, line

MM = 72 / 25.4


def with_template(template):
    """A page of 100 x 80 mm with a line near its lower left corner."""
    return replace(
        drawing([line([(10, 10), (20, 10)])]), page=Page("test", 100.0, 80.0, 0.0, 0.0), sheet=Sheet((), template)
    )


def content_of(data):
    """The page's commands."""
    start = data.index(b"stream\n", data.index(b"/FlateDecode")) + len(b"stream\n")
    return zlib.decompressobj().decompress(data[start:]).decode("ascii")


def image(made, dots_per_mm=4):
    """The page as grey values (h, w), through a PDF reader that is not ours. made: a drawing, or the file's content."""
    page = pypdfium2.PdfDocument(made if isinstance(made, bytes) else pdf(made))[0]
    return np.asarray(page.render(scale=dots_per_mm / MM).to_pil().convert("L")).astype(int)
