"""A PDF looked at: its commands, and its page as pixels."""

import zlib

import numpy as np
import pypdfium2

from hlr.writers.pdf import pdf

MM = 72 / 25.4


def content_of(data):
    """The page's commands."""
    start = data.index(b"stream\n", data.index(b"/FlateDecode")) + len(b"stream\n")
    return zlib.decompressobj().decompress(data[start:]).decode("ascii")


def image(made, dots_per_mm=4):
    """The page as grey values (h, w), through a PDF reader that is not ours. made: a drawing, or the file's content."""
    page = pypdfium2.PdfDocument(made if isinstance(made, bytes) else pdf(made))[0]
    return np.asarray(page.render(scale=dots_per_mm / MM).to_pil().convert("L")).astype(int)
