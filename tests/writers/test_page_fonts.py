"""Texts of a page in PDF and PNG whose letters Helvetica has not: they are in the font of the package."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import zlib

import numpy as np
import pypdfium2
import pytest
from fontTools.ttLib import TTFont
from PIL import Image, ImageDraw, ImageFont
from writers import golden
from writers.pages import content_of, image, with_template

from hlr.writers import page_fonts, shipped_font
from hlr.writers.left_out import left_out
from support.programs import environment

WORDS = (
    "Привет, ЧЕРТЁЖ № 7",
    "Ελληνικά ώς Ω",
    "Łódź śruba żółć",
    "Příliš žluťoučký kůň",
    "⌀12 ≥ 5 → ½ × ∅",
    "AΑА HΗН",  # Latin, Greek and Cyrillic letters of the same look
)
PLAIN = ("größer € – 5 µm", "plain text")


def texts(*words, **more):
    """A page with these texts, one below the other, 5 mm high; more: attributes of each."""
    told = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in more.items())
    lines = [f'<text y="{10 + 8 * i}" font-size="5"{told}>{each}</text>' for i, each in enumerate(words)]
    return with_template(f'<svg width="100" height="80" viewBox="0 0 100 80">{"".join(lines)}</svg>')


def read_back(data):
    return pypdfium2.PdfDocument(data)[0].get_textpage().get_text_range().split("\r\n")


def columns_of(made, y):
    """The first and last column with ink, in millimetres, of the text whose base line is at y."""
    dark = image(made, 20)[20 * (y - 5) : 20 * (y + 1)] < 128
    columns = np.flatnonzero(dark.any(axis=0))
    return columns[0] / 20, (columns[-1] + 1) / 20


def streams(data):
    """The streams of a file, as they were before they were compressed."""
    found = re.findall(rb"/FlateDecode[^>]*>>\nstream\n(.*?)\nendstream", data, re.DOTALL)
    return [zlib.decompress(each) for each in found]


def embedded_font(data):
    (file,) = [each for each in streams(data) if each.startswith(b"\0\1\0\0")]
    return TTFont(io.BytesIO(file), recalcTimestamp=False)


def test_texts_can_be_read_back():
    assert read_back(texts(*WORDS, x=5).to_pdf()) == list(WORDS)


@pytest.mark.parametrize("words", WORDS[:5])
def test_letters_look_as_the_font_has_them(words):
    """A glyph that is taken for another one, or a wrong width, would shift or change the ink."""
    dots, size = 20, 5 * 20
    expected = Image.new("L", (100 * dots, 80 * dots), 255)
    font = ImageFont.truetype(shipped_font.FILE, size, layout_engine=ImageFont.Layout.BASIC)
    x = 5.0 * dots
    for letter in words:
        ImageDraw.Draw(expected).text((x, 10 * dots), letter, 0, font, anchor="ls")
        x += size * shipped_font.advances()[letter]
    place = np.s_[: 12 * dots, : 100 * dots]
    ink, told = image(texts(words, x=5), dots)[place] < 128, np.asarray(expected)[place] < 128
    assert (ink & told).sum() > 0.85 * (ink | told).sum()


def test_png_has_the_letters():
    def pixels(made):
        return np.asarray(Image.open(io.BytesIO(made.to_png())).convert("L")).astype(int)

    drawn, asked = pixels(texts(WORDS[0], x=5)), pixels(texts(re.sub(r"[^ -~]", "?", WORDS[0]), x=5))
    dots = drawn.shape[1] / 100.0
    place = np.s_[int(6 * dots) : int(11 * dots), int(5 * dots) : int(60 * dots)]
    assert (drawn[place] < 128).mean() > 0.05
    assert (drawn[place] != asked[place]).mean() > 0.05


@pytest.mark.parametrize("words", ["ЖЩЮЖЩЮЖЩЮ", "ⅠⅠⅠⅠⅠⅠ ⌀", "HHH"])
def test_anchors_are_where_the_text_begins_and_ends(words):
    start, end = columns_of(texts(words, x=10), 10)
    assert start == pytest.approx(10.3, abs=0.3)
    width = end - start
    assert columns_of(texts(words, x=90, text_anchor="end"), 10)[1] == pytest.approx(89.7, abs=0.3)
    left, right = columns_of(texts(words, x=50, text_anchor="middle"), 10)
    assert right - left == pytest.approx(width, abs=0.15)
    assert 0.5 * (left + right) == pytest.approx(50, abs=0.2)


def test_a_text_is_in_one_font():
    content = content_of(texts("Ünal ≥ 5", "Ünal", x=5).to_pdf())
    assert re.findall(r"/(\w) 5 Tf", content) == [page_fonts.SHIPPED, page_fonts.HELVETICA]


def test_only_what_the_page_uses_is_embedded():
    data = texts("Привет", "AΑА ≥", *PLAIN, x=5).to_pdf()
    # Those of eleven letters, one for what is not there, and parts that others are put together of.
    assert 12 <= embedded_font(data)["maxp"].numGlyphs <= 16
    assert len(data) < 12_000
    assert re.search(rb"/BaseFont /[A-Z]{6}\+DejaVuSans", data)


def test_more_than_a_hundred_letters():
    """The map for searching has them in blocks."""
    letters = "".join(chr(code) for code in range(0x410, 0x4F0) if chr(code) in shipped_font.advances())
    rows = [letters[i : i + 30] for i in range(0, len(letters), 30)]
    assert len(letters) > 200
    assert read_back(texts(*rows, x=5, style="font-size:2px").to_pdf()) == rows


def test_letters_and_their_accents_are_one_where_unicode_has_that():
    assert read_back(texts("Cafe\u0301 \u212b", x=5).to_pdf()) == ["Café Å"]
    assert texts("Cafe\u0301 \u212b", x=5).to_pdf() == texts("Café Å", x=5).to_pdf()
    assert texts("и\u0306 >", x=5).to_pdf() == texts("й >", x=5).to_pdf()
    # An accent that no letter has is drawn over it.
    plain, accented = columns_of(texts("Я", x=5), 10), columns_of(texts("Я\u0301", x=5), 10)
    assert accented == pytest.approx(plain, abs=0.1)


PROGRAM = """
import sys
from hashlib import sha256
from writers.test_page_fonts import PLAIN, WORDS, texts
for words in (WORDS, PLAIN):
    page = texts(*words, x=5)
    print(sha256(page.to_pdf() + page.to_png()).hexdigest())
"""


@pytest.mark.slow
def test_the_same_bytes_in_any_process_at_any_time():
    def run(seed):
        # The font's tool asks this variable for the time.
        env = environment(PYTHONHASHSEED=seed, SOURCE_DATE_EPOCH=f"{seed}00000")
        command = [sys.executable, "-P", "-c", PROGRAM]
        return subprocess.run(command, env=env, capture_output=True, text=True, check=True).stdout

    first = run("1")
    assert len(set(first.split())) == 2
    assert first == run("2")


UNLOADED = """
import sys
from writers.pages import with_template
from hlr.writers.left_out import left_out
page = with_template(sys.argv[1])
page.to_pdf(), page.to_png(), left_out(page, "pdf", "a.pdf")
print("hlr.writers.template_pdf" in sys.modules, "fontTools" in sys.modules, "hlr.writers.shipped_font" in sys.modules)
"""


@pytest.mark.slow
@pytest.mark.parametrize(("words", "loaded"), [("größer € –", False), ("≥ 5", True)])
def test_the_font_is_loaded_only_if_a_text_needs_it(words, loaded):
    command = [sys.executable, "-P", "-c", UNLOADED, texts(words).sheet.template]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", str(loaded), str(loaded)]


@pytest.mark.parametrize("more", ["", "図面"])
def test_pages_that_need_no_other_font_are_as_they_were(more):
    """What neither font has is a question mark in Helvetica, if the rest of the text is in it."""
    words = (*PLAIN, f"{more or '??'} 5 Ünal")
    data = texts(*words, x=50, text_anchor="middle").to_pdf()
    golden.check("texts.pdf.txt", content_of(data))
    assert b"/Font <</T << /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>>>" in data
    assert b"Type0" not in data
    assert len(streams(data)) == 1


def test_what_neither_font_has_is_a_question_mark_and_named():
    page = texts("図 Привет \U0001d6fc", "עברית ab", x=5)
    assert read_back(page.to_pdf()) == ["? Привет ?", "????? ab"]
    (note,) = left_out(page, "pdf", "a.pdf")
    assert '"図", "𝛼", "ע", "ב", "ר" and 2 more not drawn in a.pdf, but ? instead' in note.text


def test_what_the_font_has_is_not_named():
    assert left_out(texts(*WORDS, *PLAIN, "a\u3000b Cafe\u0301"), "png", "a.png") == []


def test_the_font_has_what_its_page_says():
    """Its letters are those of matplotlib's DejaVu Sans in the ranges of the command that made it."""
    import matplotlib

    page = (shipped_font.FILE.parent / "README.md").read_text("utf-8")
    (ranges,) = re.findall(r"--unicodes=(\S+)", page)
    codes = set()
    for each in ranges.split(","):
        first, _, last = each.partition("-")
        codes |= set(range(int(first, 16), int(last or first, 16) + 1))
    whole = TTFont(f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf")
    ours, theirs = TTFont(shipped_font.FILE), whole.getBestCmap()
    assert set(ours.getBestCmap()) == codes & set(theirs)
    for code, name in ours.getBestCmap().items():
        assert ours["hmtx"][name] == whole["hmtx"][theirs[code]]
    assert not {"fpgm", "cvt ", "prep", "GSUB", "GPOS"} & set(ours.keys())
    assert shipped_font.FILE.stat().st_size < 250_000
    assert "Bitstream Vera Fonts Copyright" in (shipped_font.FILE.parent / "LICENSE_DEJAVU").read_text("utf-8")


def test_the_font_has_all_that_helvetica_has():
    """A text with one letter of the font is set in it whole. Letters have two bytes there."""
    helvetica = bytes(range(0x20, 0x100)).decode(page_fonts.ENCODING, "ignore").replace("\x7f", "")
    assert set(helvetica) <= set(shipped_font.advances())
    assert max(shipped_font.advances()) <= "\uffff"
