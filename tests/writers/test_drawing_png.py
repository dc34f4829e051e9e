"""PNG of a line drawing: its PDF in pixels."""

import io

import numpy as np
import pytest
from PIL import Image
from writers.pages import image

import hlr
from hlr.writers.drawing_png import drawing_png
from support.drawings import drawing, line, sample


def opened(made):
    return Image.open(io.BytesIO(drawing_png(made)))


def test_a_millimetre_is_as_many_pixels_as_the_file_says():
    made = drawing([line([[0, 0], [40, 0]]), line([[0, 0], [0, 30]])])  # 51 x 41 mm with its border
    for asked, dpi in (({}, 200), ({"dpi": 96}, 96)):
        picture = opened(made.with_style(asked))
        assert picture.size == (round(51 * dpi / 25.4), round(41 * dpi / 25.4))
        assert picture.info["dpi"] == pytest.approx((dpi, dpi), abs=0.02)
        assert (picture.mode, picture.info["Source"]) == ("RGB", "box.step")


def test_a_size_holds_the_whole_page_in_its_middle():
    made = drawing([line([[0, 0], [40, 0], [40, 40], [0, 40], [0, 0]])])
    picture = opened(made.with_style({"size": [600, 300]}))
    ink = np.asarray(picture.convert("L")) < 128
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    assert picture.size == (600, 300)
    assert (rows[0], columns[0]) == pytest.approx((299 - rows[-1], 599 - columns[-1]), abs=1)
    assert picture.info["dpi"][0] == pytest.approx(300 / 51 * 25.4, abs=0.02)
    assert len(columns) == pytest.approx(40.5 * 300 / 51, abs=2)


def near(ink):
    """Pixels that are ink or beside it."""
    padded = np.pad(ink, 1)
    return np.any([padded[i : i + len(ink), j : j + ink.shape[1]] for i in range(3) for j in range(3)], axis=0)


def test_the_lines_are_those_of_the_pdf():
    made = sample().with_style({"dpi": 254})
    ours = np.asarray(opened(made).convert("L")) < 128
    theirs = image(made, 10)[: ours.shape[0], : ours.shape[1]] < 128  # whose page is a part of a pixel larger
    assert ours.sum() > 1000
    assert not (ours & ~near(theirs)).any() and not (theirs & ~near(ours)).any()


def test_the_same_bytes_again():
    assert drawing_png(sample()) == drawing_png(sample()) == sample().to_png()


def test_too_many_pixels_are_refused_before_any_is_made(tmp_path):
    large = drawing([line([[0, 0], [9000, 9000]])])
    with pytest.raises(hlr.WriteError, match="give fewer dpi, a size in pixels, or a smaller scale"):
        large.save(tmp_path / "a.png")
    assert not list(tmp_path.iterdir())
    assert opened(large.with_style({"size": [64, 64]})).size == (64, 64)
