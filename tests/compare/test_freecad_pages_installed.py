"""Five documents that an installed FreeCAD makes: their views, drawn by hlr, beside FreeCAD's own drawings of them."""

from __future__ import annotations

from pathlib import Path

import pytest

import hlr
from hlr.compare import compare
from hlr.compare.reading.document import page_of
from support.installed_freecad import needs_freecad, run

SCRIPT = Path(__file__).parents[1] / "support" / "freecad_makes_pages.py"

OURS_ONLY = {"arrays": 85.0}
"""Millimetres of a view: where bricks of an array pass through one another, FreeCAD draws no line."""

THEIRS_ONLY = {"arrays": 7.0, "linked_groups": 41.0, "projection_group": 47.0, "turned_bodies": 12.0}
"""Hidden lines that lie closer to visible ones than a pen is wide, and edges within a plane, which are seams to hlr.

With FreeCAD 1.0.0 also visible ones of those.
"""


@needs_freecad
@pytest.mark.slow
def test_views_show_what_freecad_shows(tmp_path):
    said = run(SCRIPT, HLR_FREECAD_FOLDER=str(tmp_path))
    folders = sorted(path for path in tmp_path.iterdir() if path.is_dir())
    assert len(folders) == 5, said
    views = 0
    for folder in folders:
        document = folder / f"{folder.name}.FCStd"
        (page,) = hlr.draw_pages(document)
        assert page.notes == (), folder.name
        for view in page.sheet.views:
            alone = page_of(document, f"Page/{view.name}", 0.05).drawing
            found = compare(alone, folder / f"{folder.name}.{view.name}.frag.svg", tolerance_mm=0.05)
            lengths, what = found.lengths_mm, (folder.name, view.name, found.summary)
            assert lengths["gone"] <= OURS_ONLY.get(folder.name, 0.1), what
            assert lengths["new"] <= THEIRS_ONLY.get(folder.name, 3.0), what
            assert lengths["moved"] + lengths["visibility changed"] <= 0.1, what
            assert found.same_mm > 100.0, what
            assert found.motion is not None and not found.motion.words(), what
            views += 1
    assert views == 18
