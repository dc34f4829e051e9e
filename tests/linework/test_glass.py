"""Transparent parts in a line drawing: they hide like others, with a remark, unless they are to be seen through."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from hlr.errors import OptionError
from support.at_size import AT_SIZE


def lamp(opacity: int = 90) -> trimesh.Scene:
    """A bulb in a box of glass."""
    scene = trimesh.Scene()
    for name, size, colour in (("glass", 40.0, (40, 90, 220, opacity)), ("bulb", 10.0, (220, 20, 20, 255))):
        box = trimesh.creation.box((size, size, size))
        box.visual.face_colors = np.tile(np.array(colour, np.uint8), (12, 1))
        scene.add_geometry(box, node_name=name, geom_name=name)
    return scene


def seen(drawing: hlr.Drawing, name: str) -> int:
    return sum(drawing.parts[line.part].name == name for line in drawing.visible)


def test_glass_hides_and_a_remark_says_so() -> None:
    drawing = hlr.draw(lamp(), **AT_SIZE)
    assert seen(drawing, "bulb") == 0 and seen(drawing, "glass") == 9
    (note,) = [note for note in drawing.notes if note.code == "glass-hides"]
    assert not note.is_warning and str(note).startswith('Part "glass" is transparent and hides')
    assert str(note).endswith("--see-through shows it (in Python, see_through=True).")
    hlr.draw(lamp(), strict=True, **AT_SIZE)


def test_it_is_seen_through_where_that_is_asked_for() -> None:
    drawing = hlr.draw(lamp(), (1, -2, 0.7), see_through=True, **AT_SIZE)
    # The bulb hides its own back, and of the glass what lies behind it; of the glass all twelve edges are seen.
    assert seen(drawing, "bulb") == 9 and seen(drawing, "glass") >= 12
    assert not drawing.notes
    (row,) = [d for d in drawing.plan if d.name == "seeing through glass"]
    assert row.on and row.counts == {"glass_triangles": 12}


def test_all_of_a_rim_of_glass_is_seen() -> None:
    """Also where the glass itself would hide it, close to its outlines."""
    tumbler = cq.Assembly().add(cq.Workplane().circle(10).extrude(20), name="tumbler", color=cq.Color(0.5, 0.5, 1, 0.3))
    drawing = hlr.draw(tumbler, see_through=True, **AT_SIZE)
    (rim, *_) = sorted(
        (line for line in drawing.visible if line.kind == "sharp"), key=lambda line: line.points[:, 1].min()
    )
    ends = [end for line in drawing.visible if line.edge == rim.edge for end in line.points[[0, -1]]]
    apart = np.linalg.norm(np.array(ends)[:, None] - np.array(ends), axis=2) + 100.0 * np.eye(len(ends))
    assert len(ends) > 2 and apart.min(axis=1).max() < 0.3


def test_without_glass_nothing_changes() -> None:
    plain, asked = hlr.draw(lamp(255), **AT_SIZE), hlr.draw(lamp(255), see_through=True, **AT_SIZE)
    assert plain.lines == asked.lines and not plain.notes and not asked.notes


def test_a_report_cannot_judge_it() -> None:
    with pytest.raises(OptionError, match="report measures what all parts hide"):
        hlr.draw(lamp(), see_through=True, report=True, **AT_SIZE)
