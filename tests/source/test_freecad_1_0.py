"""A document that FreeCAD 1.0.0 made in its window: binary shapes, appearances of faces, a link, a page of views."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hlr.compare import compare
from hlr.compare.reading.document import page_of
from hlr.source import open_source
from hlr.source.cad.source_builder import build_source
from hlr.source.freecad.fcstd import read_document

FOLDER = Path(__file__).parents[1] / "data" / "freecad" / "version_1_0"
DOCUMENT = FOLDER / "document.FCStd"


def test_its_parts_lie_where_freecad_has_them():
    source = open_source(DOCUMENT)
    assert source.names() == ["Cut", "Group/Ball", "Link"]
    assert np.allclose(source.bounds(), [[-15.0, 0.0, 0.0], [68.0, 105.981, 20.0]], atol=0.001)


def test_opencascade_is_not_loaded_and_would_read_the_same():
    code = f"import sys; from hlr.source import open_source; open_source({str(DOCUMENT)!r}); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True)
    assert "numpy" in done.stdout.split() and "OCP" not in done.stdout.split()
    leaves, notes = read_document(DOCUMENT, opencascade=True)
    loaded, lean = build_source(DOCUMENT.name, "fcstd", leaves, notes), open_source(DOCUMENT)
    pairs = zip(loaded.mesh(0.05, 0.3).parts, lean.mesh(0.05, 0.3).parts, strict=True)
    assert all(np.array_equal(a.points, b.points) and np.array_equal(a.triangles, b.triangles) for a, b in pairs)


def test_each_face_has_its_own_colour():
    """The link shows the cut in the colours of the cut; the sphere is half transparent."""
    looks = open_source(DOCUMENT).appearances()
    for name in ("Cut", "Link"):
        for number in range(7):
            expected = (0.1 * number, 0.5, 1.0 - 0.1 * number, 1.0)
            assert looks[name].faces[number] == pytest.approx(expected, abs=1 / 255)
    assert looks["Group/Ball"].whole == pytest.approx((0.0, 0.8, 0.2, 0.6), abs=1 / 255)


@pytest.mark.parametrize("view", ["Front", "Top", "Iso"])
def test_views_of_its_page_show_what_freecad_shows(view):
    ours = page_of(DOCUMENT, f"Page/{view}", 0.05).drawing
    found = compare(FOLDER / f"{view}.svg", ours, tolerance_mm=0.05)
    seen = [each for each in found.differences if not found.looks_same(each)]
    assert sum(each.length_mm for each in seen) < 1.0 and {each.visible for each in seen} <= {False}, found
    assert found.same_mm > 300.0 and not found.motion.words()
