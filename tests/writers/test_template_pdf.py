"""The template of a page in PDF and PNG: paths and texts where SVG has them."""

from __future__ import annotations

import io

import numpy as np
import pypdfium2
import pytest
from PIL import Image
from writers.pages import with_template

from hlr.errors import WriteError
from hlr.writers.left_out import left_out
from support.drawings import drawing, line

TEMPLATE = """<svg width="100" height="80" viewBox="0 0 200 160">
<g transform="translate(20 0)" style="stroke:#ff0000;stroke-width:4;fill:none">
<rect x="20" y="20" width="100" height="60"/>
<path d="M 20 100 A 20 20 0 0 1 60 100 Q 80 80 100 100 z" fill="#0000ff" stroke="none"/>
</g>
<path d="M 0 150 h 200" stroke="#00ff00" stroke-width="2" stroke-dasharray="20 20"/>
<text x="40" y="140" font-size="10">a &lt; b</text>
<text x="180" y="140" font-size="10" text-anchor="end">Ünal <tspan display="none">not</tspan></text>
</svg>"""


def sheet(template=TEMPLATE):
    return with_template(template)


def pixels(shown):
    """The colour at a place in millimetres from the upper left corner."""
    image = np.asarray(Image.open(io.BytesIO(shown.to_png())).convert("RGB"))
    dots = image.shape[1] / 100.0

    def at(x, y):
        return tuple(int(v) for v in image[int(y * dots), int(x * dots)])

    return at


RED, BLUE, GREEN, WHITE = (255, 0, 0), (0, 0, 255), (0, 255, 0), (255, 255, 255)


def test_paths_lie_where_svg_has_them():
    at = pixels(sheet())
    # Half as large as in its own units. The rectangle's left side is at 20 mm, 2 mm wide.
    for x, y, color in (
        (20, 25, RED),
        (20.8, 25, RED),
        (19.2, 25, RED),
        (18.5, 25, WHITE),
        (45, 25, WHITE),
        (30, 45, BLUE),  # under the arc
        (30, 38, WHITE),
        (50, 47, BLUE),  # under the spline
        (5, 75, GREEN),
        (15, 75, WHITE),  # a gap
    ):
        assert at(x, y) == color, (x, y)


def test_texts_are_texts():
    page = pypdfium2.PdfDocument(sheet().to_pdf())[0].get_textpage()
    text = page.get_text_range()
    assert "a < b" in text and "Ünal" in text
    mm = 72 / 25.4
    left, bottom, _, _ = page.get_charbox(text.index("a < b"), loose=False)
    assert left / mm == pytest.approx(20, abs=0.5) and bottom / mm == pytest.approx(10, abs=0.2)
    right = page.get_charbox(text.index("Ünal") + 3, loose=False)[2]
    assert right / mm == pytest.approx(90, abs=0.6)


def test_the_same_bytes():
    assert sheet().to_pdf() == sheet().to_pdf()


def test_what_is_no_svg_is_refused():
    with pytest.raises(WriteError, match="template of the page cannot be drawn in PDF"):
        sheet('<svg viewBox="0 0 1 1"><path d="M 0 0 L 1').to_pdf()


def of_gradients(*defined):
    """Two squares, filled with the gradients a and b."""
    return f"""<svg width="100" height="80"><defs>{"".join(defined)}</defs>
<rect x="10" y="10" width="20" height="20" style="fill:url(#a);stroke:none"/>
<rect x="50" y="10" width="20" height="20" fill="url('#b')"/></svg>"""


STOPS = '<stop offset="0" style="stop-opacity:1;stop-color:#ff0000"/><stop offset="1" stop-color="#0000ff"/>'


def test_gradients_have_the_mean_of_their_colours():
    """The logo in the default template of FreeCAD was a black blot."""
    stated = f'<linearGradient id="a">{STOPS}</linearGradient>'
    at = pixels(sheet(of_gradients(stated, '<radialGradient id="b" href="#a"/>')))
    assert at(20, 20) == at(60, 20) == (128, 0, 128)


@pytest.mark.parametrize("own", ['<linearGradient id="a" href="#b"/><radialGradient id="b" href="#a"/>'])
def test_gradients_without_colours_paint_nothing(own):
    at = pixels(sheet(of_gradients(own)))
    assert at(20, 20) == at(60, 20) == WHITE


def test_letters_that_pdf_has_not_are_named():
    page = sheet(TEMPLATE.replace("Ünal", "größer ≥ 5 Ω, 図面番号 – 𝛼 עברית \u3000図"))
    for format in ("pdf", "png"):
        (note,) = left_out(page, format, f"a.{format}")
        assert (note.code, note.is_warning) == ("page-items-left-out", True)
        assert note.text == (
            f'Page "{page.view.name}": "図", "面", "番", "号", "𝛼" and 5 more not drawn in a.{format}, but ? instead: '
            "SVG has all letters."
        )
    assert left_out(page, "svg", "a.svg") == []
    assert left_out(page, "dxf", "a.dxf") == []


def test_letters_that_nobody_sees_are_not_named():
    assert left_out(sheet(), "pdf", "a.pdf") == []
    hidden = (
        '<title>図</title><g display="none"><text>図</text></g><text>a<tspan visibility="hidden">図</tspan> €</text>'
    )
    assert left_out(sheet(hidden), "pdf", "a.pdf") == []
    assert left_out(drawing([line([(10, 10), (20, 10)])]), "pdf", "a.pdf") == []
