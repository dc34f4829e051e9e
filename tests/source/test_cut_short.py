"""A file that ends too early is refused, or drawn with a warning: never taken for a whole one."""

from pathlib import Path

import pytest

from hlr.errors import SourceError
from hlr.source import open_source

SEEDS = Path(__file__).resolve().parents[1] / "fuzz/corpus/seeds"
NAMES = ["block.step", "block.igs", "block.brep", "box.stl", "ball.stl", "box.ply", "text.ply", "box.off", "pair.glb"]


def cut(tmp_path, name, share):
    data = (SEEDS / name).read_bytes()
    path = tmp_path / f"cut{Path(name).suffix}"
    path.write_bytes(data[: int(len(data) * share)])
    return path


@pytest.mark.parametrize("share", [0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99])
@pytest.mark.parametrize("name", NAMES)
def test_what_is_cut_short_is_noticed(tmp_path, name, share):
    if name.endswith((".step", ".igs", ".brep")):
        pytest.importorskip("cadquery")
    try:
        source = open_source(cut(tmp_path, name, share))
    except SourceError as error:
        assert any(words in str(error) for words in ("cut short", "broken", "incomplete")), error
        return
    assert [note for note in source.notes if note.code == "cut-short" and note.is_warning]


def test_the_last_record_of_iges(tmp_path):
    pytest.importorskip("cadquery")
    data = (SEEDS / "block.igs").read_bytes()
    whole = tmp_path / "whole.igs"
    for end in (b"", b"\r\n\n", b"\x1a", b"\n\0\0\0"):
        whole.write_bytes(data.rstrip() + end)
        assert "cut-short" not in [note.code for note in open_source(whole).notes]
    assert "cut-short" in [note.code for note in open_source(cut(tmp_path, "block.igs", 0.999)).notes]


@pytest.mark.parametrize("name", ["text.ply", "box.off"])
def test_the_last_row_may_lack_its_line_end_and_have_a_comment_or_more_lines_after_it(tmp_path, name):
    data = (SEEDS / name).read_bytes().rstrip()
    path = tmp_path / name
    for end in (b"", b"\r\n", b"\n\n \n"):
        path.write_bytes(data + end)
        assert open_source(path).notes == []
    words = data.split(b"\n")
    path.write_bytes(b"\n".join([*words[:-1], words[-1].rsplit(maxsplit=1)[0]]))
    with pytest.raises(SourceError, match="last row is not whole"):
        open_source(path)
    path.write_bytes(b"\n".join(words[:-1]))
    with pytest.raises(SourceError, match="cut short: its header announces 20 rows"):
        open_source(path)
