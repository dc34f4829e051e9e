import re
from dataclasses import replace

import numpy as np
import pypdfium2
import pytest
from writers import golden
from writers.pages import MM, content_of, image

from hlr.writers.pdf import pdf
from support.drawings import drawing, line, on_page, part, sample


def test_golden():
    golden.check("sample.pdf.txt", content_of(pdf(sample())))
    golden.check("page.pdf.txt", content_of(pdf(on_page())))


def test_the_golden_file_notices_a_hundredth_of_a_millimetre():
    made = sample()
    moved = replace(made.lines[4], points=made.lines[4].points + [[0.01, 0.0], [0.0, 0.0]])
    changed = replace(made, lines=(*made.lines[:4], moved, *made.lines[5:]))
    assert content_of(pdf(changed)) != (golden.GOLDEN / "sample.pdf.txt").read_text()


def test_the_page_has_the_size_of_the_drawing():
    document = pypdfium2.PdfDocument(pdf(drawing([line([[-10, 20], [30, 50]])])))
    assert len(document) == 1
    assert document[0].get_size() == pytest.approx((51 * MM, 41 * MM), abs=1e-3)


def test_lines_are_where_they_belong():
    ink = image(drawing([line([[0, 0], [20, 0]]), line([[0, 0], [0, 10]])])) < 128
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    # 5.5 mm of margin at 4 dots per millimetre; half a line width around; y up.
    assert (rows[0], rows[-1]) == pytest.approx((21, 63), abs=1)
    assert (columns[0], columns[-1]) == pytest.approx((21, 103), abs=1)
    assert ink[60:64, 30:100].any()
    assert not ink[20:55, 30:100].any()


def test_hidden_lines_are_dashed_and_visible_ones_are_not():
    for visible, share in ((True, 1.0), (False, 0.8)):
        ink = image(drawing([line([[0, 0], [37.5, 0]], visible=visible)]), 20) < 128
        covered = ink.any(axis=0)[110:860]
        assert covered.mean() == pytest.approx(share, abs=0.02)


def test_one_layer_per_class_and_visibility():
    data = pdf(sample())
    names = re.findall(rb"/Type /OCG/Name \(([^)]*)\)", data)
    assert names == [
        b"Hidden smooth",
        b"Hidden sharp",
        b"Hidden outline",
        b"Visible smooth",
        b"Visible seam",
        b"Visible boundary",
        b"Visible intersection",
        b"Visible sharp",
        b"Visible outline",
    ]
    content = content_of(data)
    assert content.count("BDC") == content.count("EMC") == len(names)
    assert b"/OCProperties" in data


def test_layers_can_be_switched_off():
    data = pdf(sample())
    assert (image(data) < 128).any()
    assert (image(data.replace(b"/ON [", b"/OFF[")) == 255).all()


def test_the_title_says_what_is_drawn():
    document = pypdfium2.PdfDocument(pdf(drawing([], source="(Größe)\\.step")))
    assert document.get_metadata_dict()["Title"] == "(Größe)\\.step, iso, 1:1"


def test_a_name_with_half_a_character_is_no_obstacle():
    pypdfium2.PdfDocument(pdf(drawing([], source="a\udc80.step")))


def test_no_dates_and_the_same_bytes_again():
    data = pdf(sample())
    assert data == pdf(sample())
    assert b"Date" not in data


def test_a_page_beyond_the_largest_grows_its_unit():
    data = pdf(drawing([line([[0, 0], [12000, 10]])]))
    assert b"/UserUnit 3" in data
    # The reader applies the unit or ignores it; the box itself stays within the limit of the format.
    box = [float(x) for x in re.search(rb"/MediaBox \[([^\]]*)\]", data)[1].split()]
    assert max(box) <= 14400


def test_an_empty_drawing_is_a_valid_file():
    assert (image(drawing([], parts=[part()])) == 255).all()
