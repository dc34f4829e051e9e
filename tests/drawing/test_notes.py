"""Notes: a code for programs, a sentence for people, one table of codes."""

import json
import re
from pathlib import Path
from typing import get_args

import pytest
import trimesh

import hlr
from hlr.drawing.notes import CODES, REMARKS, Note, NoteCode
from support.at_size import AT_SIZE


def test_there_is_one_table_of_codes_and_the_format_describes_it():
    assert get_args(NoteCode) == tuple(CODES)
    described = (Path(hlr.__file__).parent / "docs" / "json.md").read_text()
    assert all(f"| `{code}` | {meaning} |" in described for code, meaning in CODES.items())
    remarks = re.split(r" are remarks, the others\swarnings", described)[0].rpartition("\n\n")[2]
    assert set(re.findall("`(.*?)`", remarks)) == REMARKS


def test_a_note_is_a_frozen_value():
    note = Note("defects", "open")
    assert str(note) == f"{note}" == "open" and note == Note("defects", "open") != Note("more-defects", "open")
    assert len({note, Note("defects", "open")}) == 1
    with pytest.raises(AttributeError):
        note.text = "other"


def test_a_drawing_writes_code_and_text():
    drawing = hlr.draw(trimesh.creation.box((1, 1, 1)), "front", **AT_SIZE)
    (note,) = drawing.notes
    assert note.code == "paper-size" and note.text.startswith("the drawing is only")
    from hlr.drawing.saving import render

    assert json.loads(render(drawing, "json"))["notes"] == [{"code": note.code, "text": note.text}]


def test_strict_says_the_sentence_of_a_warning_and_lets_remarks_pass():
    box = trimesh.creation.box((1, 1, 1))
    assert [note.is_warning for note in hlr.draw(box, "front", strict=True, **AT_SIZE).notes] == [False]
    box.update_faces(box.face_normals[:, 2] < 0.5)
    with pytest.raises(hlr.StrictError, match=r"is drawn as it is: open"):
        hlr.draw(box, "front", strict=True, **AT_SIZE)
