"""Files in text with a byte order mark before them, as Windows' editor saves them, and files in UTF-16."""

import codecs
from pathlib import Path

import pytest

import hlr
from hlr.batch.manifest import read
from hlr.errors import OptionError, SourceError
from hlr.source import open_source

SEEDS = Path(__file__).resolve().parents[1] / "fuzz/corpus/seeds"


@pytest.mark.parametrize("name", ["box.stl", "box.obj", "box.off", "box.ply", "text.ply", "block.brep", "pair.step"])
def test_the_mark_is_passed_over(tmp_path, name):
    (tmp_path / name).write_bytes(codecs.BOM_UTF8 + (SEEDS / name).read_bytes())
    marked, plain = open_source(tmp_path / name), open_source(SEEDS / name)
    assert marked.names() == plain.names()
    shown = [hlr.draw(source, view="front", scale=1) for source in (marked, plain)]
    assert shown[0].visible and shown[0].lines == shown[1].lines


def test_a_binary_file_that_begins_with_the_same_bytes_is_read_as_it_is(tmp_path):
    text = (SEEDS / "ball.stl").read_bytes()
    (tmp_path / "ball.stl").write_bytes(codecs.BOM_UTF8 + text[3:])
    assert open_source(tmp_path / "ball.stl").names() == ["ball"]


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.igs", codecs.BOM_UTF8 + (SEEDS / "block.igs").read_bytes(), "a text editor has put a byte order mark"),
        ("a.obj", (SEEDS / "box.obj").read_text().encode("utf-16"), "text in UTF-16; save it as UTF-8, or export it"),
        ("a.off", (SEEDS / "box.off").read_text().encode("utf-16"), "text in UTF-16; save it as UTF-8, or export it"),
        ("a.ply", b"\n\n" + (SEEDS / "text.ply").read_bytes(), "is not a PLY file that can be read: its beginning is"),
        ("a.stl", b"solid x\n", "is not an STL file that can be read: its beginning is broken; export it again"),
        ("a.off", b"OFFICE\n", "is not an OFF file that can be read: its beginning is broken; export it again"),
        ("a.stl", b"ply\n", "is not an STL file: it looks like a PLY file"),
    ],
)
def test_what_is_said_of_others(tmp_path, name, data, message):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(SourceError, match=message):
        open_source(tmp_path / name)


def test_a_manifest_and_a_style_may_have_the_mark(tmp_path):
    (tmp_path / "hlr.toml").write_bytes(codecs.BOM_UTF8 + b'views = "front"\n')
    assert read(tmp_path / "hlr.toml").rules[0].values["views"] == "front"
    (tmp_path / "own.toml").write_bytes(codecs.BOM_UTF8 + b"wide = 0.4\n")
    box = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    assert hlr.draw(box, style=tmp_path / "own.toml").style.wide == 0.4
    for name in ("hlr.toml", "own.toml"):
        (tmp_path / name).write_bytes('views = "front"\n'.encode("utf-16"))
    with pytest.raises(OptionError, match=r"hlr.toml is no text in UTF-8: save it as UTF-8"):
        read(tmp_path / "hlr.toml")
    with pytest.raises(OptionError, match=r"own.toml is no text in UTF-8: save it as UTF-8"):
        hlr.draw(box, style=tmp_path / "own.toml")
