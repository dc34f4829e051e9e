"""STEP assemblies whose parts are in files of their own, beside them.

Such a file names a part's file in a DOCUMENT_FILE, and ties it to the definition of a product.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import hlr
from hlr.errors import SourceError, StrictError
from hlr.source.cad.cache_key import cache_key
from hlr.source.step_references import references

BOX = Path(__file__).parents[1] / "data" / "freecad" / "box.step"

REFERENCE = """
#90001=DOCUMENT_TYPE('geometry');
#90002=DOCUMENT_FILE('{0}','','',#90001,'','');
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HLR_CACHE", str(tmp_path / "cache"))
    return tmp_path


def referring(folder, *names, of=BOX):
    """A model that refers to other files as well."""
    text = of.read_text("utf-8")
    more = "".join(REFERENCE.format(name).replace("9000", f"9{k}00") for k, name in enumerate(names))
    end = text.rindex("ENDSEC;")
    path = folder / "assembly.step"
    path.write_text(text[:end] + more + text[end:], "utf-8")
    return path


def codes(drawing):
    return [note.code for note in drawing.notes if note.is_warning]


def test_files_that_are_missing_are_named(folder):
    path = referring(folder, "near.stp", "gone.stp")
    shutil.copy(BOX, folder / "near.stp")
    drawing = hlr.draw(path, "front")
    (note,) = (note for note in drawing.notes if note.code == "references-missing")
    assert note.is_warning and "assembly.step" in note.text and "gone.stp" in note.text
    assert "near.stp" not in note.text
    with pytest.raises(StrictError, match=r"gone\.stp"):
        hlr.draw(path, "front", strict=True)


def test_where_nothing_is_left_the_error_names_them(folder):
    path = referring(folder, *(f"part{k}.stp" for k in range(7)))
    text = path.read_text("utf-8")
    # Without its representation the product has no shape.
    path.write_text(text.replace("SHAPE_DEFINITION_REPRESENTATION(", "PROPERTY_DEFINITION_REPRESENTATION("), "utf-8")
    with pytest.raises(SourceError, match=r"assembly\.step .*not beside it, part0\.stp, .*part4\.stp and 2 more: put"):
        hlr.draw(path, "front")


def test_what_another_file_holds_counts_in_the_cache(folder):
    path = referring(folder, "part.stp")
    assert codes(hlr.draw(path, "front")) == ["references-missing"]
    # It has come, and changes.
    shutil.copy(BOX, folder / "part.stp")
    assert codes(hlr.draw(path, "front")) == []
    first = len(list((folder / "cache").rglob("*")))
    assert codes(hlr.draw(path, "front")) == []
    assert len(list((folder / "cache").rglob("*"))) == first
    (folder / "part.stp").write_text(BOX.read_text("utf-8").replace("ENDSEC;", "\nENDSEC;"), "utf-8")
    hlr.draw(path, "front")
    assert len(list((folder / "cache").rglob("*"))) == first + 1


def test_references_are_found_wherever_a_file_is_read_piece_by_piece(tmp_path, monkeypatch):
    monkeypatch.setattr("hlr.source.step_references._PIECE_BYTES", 7)
    (tmp_path / "all.step").write_text("x" * 50 + "DOCUMENT_FILE('a.stp','');" + "y" * 500 + "DOCUMENT_FILE ( 'b.stp')")
    assert [path.name for path in references(tmp_path / "all.step")] == ["a.stp", "b.stp"]


def test_a_folder_may_move_and_what_cannot_be_read_is_no_fault(tmp_path):
    (tmp_path / "one").mkdir()
    path = referring(tmp_path / "one", "part.stp", "a.folder.stp")
    shutil.copy(BOX, tmp_path / "one" / "part.stp")
    (tmp_path / "one" / "a.folder.stp").mkdir()
    key = cache_key(path, "step", False)
    (tmp_path / "one").rename(tmp_path / "two")
    assert cache_key(tmp_path / "two" / path.name, "step", False) == key
    (tmp_path / "two" / "part.stp").write_text("")
    assert cache_key(tmp_path / "two" / path.name, "step", False) != key
