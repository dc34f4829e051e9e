"""PDF files as sides: ours name the layer of each line; of others, pens and dashes tell; hostile ones are refused."""

import math
import zlib

import pytest

from hlr.compare import compare
from hlr.compare.reading import pdf as pdf_side
from hlr.compare.reading.sides import side_of
from hlr.errors import SourceError
from support.drawings import arc, bezier, drawing, line, on_page, part, sample


def curves():
    return drawing(
        [
            arc((40, 15), 8, 8, (0, math.tau)),
            *(arc((30, 40), 9 + n, 4, (0.2, 0.2 + turn), n) for n, turn in enumerate((1.0, -2.0, 4.0, -5.0))),
            bezier(2, [[0, 0], [10, 20], [20, 0], [30, -20], [40, 0], [55, 3], [60, 9]], kind="smooth", visible=False),
            bezier(3, [[0, 60], [10, 80], [20, 60], [30, 50], [40, 40], [45, 60], [50, 70]]),
        ],
        accuracy=0.005,
    )


def huge():
    """Larger than a page of PDF may be in points."""
    return drawing([line([[0, 0], [5200, 30]]), line([[0, 5], [200, 5]], visible=False)])


@pytest.mark.parametrize("style", ["iso", "dark", {"layers": "part"}], ids=["iso", "dark", "parts"])
@pytest.mark.parametrize("made", [sample, on_page, curves, huge])
def test_our_pdf_and_our_svg_are_the_same(made, style, tmp_path):
    original = made().with_style(style)
    found = compare(original.save(tmp_path / "a.svg"), original.save(tmp_path / "a.pdf"), tolerance_mm=0.02)
    assert found.same, found.summary


def test_our_pdf_tells_class_and_part(tmp_path):
    lines = [line([[0, 0], [10, 0]]), line([[5, 5], [5, 25]], "smooth", visible=False, part=1)]
    original = drawing(lines, parts=(part("plate"), part("bolt ü"))).with_style({"layers": "part"})
    (one,) = compare(original.save(tmp_path / "a.pdf"), drawing(lines[:1])).differences
    assert (one.part, one.line_class, one.visible) == ("bolt ü", "smooth", False)
    assert one.place == (5.0, 15.0) and one.length_mm == pytest.approx(20.0, abs=1e-3)


def file(tmp_path, commands, producer="another", pages=1, stream=None):
    """A PDF of A4 size that another program might have written."""
    data = commands if stream is None else stream
    length = f"/Length {len(data)}" + ("" if stream is None else " /Filter /FlateDecode")
    leaf = "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</XObject<</F 6 0 R>>>>>>"
    form = b"0 0 m 72 0 l S"
    bodies = [
        b"<</Type/Catalog/Pages 2 0 R>>",
        f"<</Type/Pages/Kids[{' '.join(['3 0 R'] * pages)}]/Count {pages}>>".encode(),
        leaf.encode(),
        f"<<{length}>>stream\n".encode() + data + b"\nendstream",
        f"<</Producer({producer})>>".encode(),
        f"<</Type/XObject/Subtype/Form/BBox[0 0 99 99]/Matrix[1 0 0 1 0 72]/Length {len(form)}>>stream\n".encode()
        + form
        + b"\nendstream",
    ]
    out, places = b"%PDF-1.4\n", []
    for number, body in enumerate(bodies, 1):
        places.append(len(out))
        out += f"{number} 0 obj\n".encode() + body + b"\nendobj\n"
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    trailer = f"trailer<</Size 7/Root 1 0 R/Info 5 0 R>>\nstartxref\n{len(out)}\n%%EOF\n"
    end = f"xref\n0 7\n0000000000 65535 f \n{table}{trailer}"
    path = tmp_path / "other.pdf"
    path.write_bytes(out + end.encode())
    return path


def rows(path):
    """(visible, x0, y0, x1, y1) of each piece, in whole millimetres."""
    pieces = side_of(path, 0.1).pieces
    ends = [*pieces.start.round().astype(int).T.tolist(), *pieces.end.round().astype(int).T.tolist()]
    return list(zip(pieces.visible.tolist(), *ends, strict=True))


def test_another_program_s_paths_lie_where_they_are_drawn(tmp_path):
    commands = b"72 0 m 144 0 l 144 72 l h S 2 0 0 2 0 0 cm 0 0 1 rg 0 0 9 9 re f /F Do"
    path = file(tmp_path, commands)
    square = [(-1, 25, 0, 51, 0), (-1, 51, 0, 51, 25), (-1, 51, 25, 25, 0)]
    assert rows(path) == [*square, (-1, 0, 51, 51, 51)]
    assert side_of(path, 0.1).about.left_out == {"filled areas": 1}


def test_dashes_are_hidden_lines_and_chains_are_axes(tmp_path):
    commands = b"[3 1] 0 d 0 0 m 72 0 l S [9 1 0 1] 0 d 0 9 m 72 9 l S [] 0 d 0 72 m 72 72 l S"
    path = file(tmp_path, commands)
    assert rows(path) == [(0, 0, 0, 25, 0), (1, 0, 25, 25, 25)]
    assert side_of(path, 0.1).about.left_out == {"centre lines": 1}


@pytest.mark.parametrize("width", [b"0", b"7"], ids=["0.20", "1.0"])
def test_of_freecad_s_pages_the_lines_with_their_join_are_the_edges(width, tmp_path):
    commands = b"1 J 2 j %s w 0 0 m 72 0 l S 1 j .35 w 0 72 m 72 72 l S" % width
    assert rows(file(tmp_path, commands, "Qt 5.15.8")) == [(-1, 0, 0, 25, 0)]
    assert len(rows(file(tmp_path, commands, "another"))) == 2


def test_a_file_whose_author_is_no_text_is_read(tmp_path):
    path = file(tmp_path, b"0 0 m 72 0 l S", "PPPP")
    path.write_bytes(path.read_bytes().replace(b"(PPPP)", b"<FEFFD800>"))
    assert rows(path) == [(-1, 0, 0, 25, 0)]


HOSTILE = {
    "3 pages": {"commands": b"", "pages": 3},
    "too much memory": {"commands": b"", "stream": zlib.compress(b"0 0 m 9 9 l S " * 100_000)},
    "kilometre away": {"commands": b"9e9 0 0 9e9 0 0 cm 0 0 m 90000 5 l S".replace(b"9e9", b"9000000")},
}


@pytest.mark.parametrize("word", HOSTILE)
def test_hostile_files_are_refused(word, tmp_path, monkeypatch):
    monkeypatch.setattr(pdf_side, "MOST_EXPANDED", 1 << 20)
    with pytest.raises(SourceError, match=rf"^other\.pdf .*{word}"):
        side_of(file(tmp_path, **HOSTILE[word]), 0.1)


@pytest.mark.parametrize("content", [b"%PDF-1.4\n", b"text", b"%PDF-1.7\n" + b"[" * 100_000])
def test_what_is_no_pdf_is_refused(content, tmp_path):
    (tmp_path / "bad.pdf").write_bytes(content)
    with pytest.raises(SourceError, match=r"^bad\.pdf cannot be read as PDF"):
        side_of(tmp_path / "bad.pdf", 0.1)
