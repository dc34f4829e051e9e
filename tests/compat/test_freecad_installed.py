"""hlr inside an installed FreeCAD: its shapes and objects are drawn, and projected as its own TechDraw does."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest

from support.installed_freecad import needs_freecad, python_of_freecad, run

SUPPORT = Path(__file__).parents[1] / "support"


@needs_freecad
@pytest.mark.slow
def test_shapes_and_objects_of_a_running_freecad(tmp_path):
    if python_of_freecad(tmp_path) != f"python {sys.version_info[0]} {sys.version_info[1]}":
        pytest.skip("FreeCAD runs another version of Python than this one: packages cannot be shared")
    folders = os.pathsep.join(folder for folder in sys.path if folder.endswith("site-packages"))
    answer = tmp_path / "answer.json"
    said = run(SUPPORT / "freecad_draws.py", HLR_FOLDERS=folders, HLR_ANSWER=str(answer))
    assert answer.exists(), said
    found = json.loads(answer.read_text())
    assert [text.split(" lines")[0] for text in found["drawings"]] == [
        "<Drawing part, iso, 5:1, 11 visible and 0 hidden",
        "<Drawing Box, iso, 10:1, 9 visible and 0 hidden",
        "<Drawing Link, iso, 10:1, 9 visible and 0 hidden",
        "<Drawing part, iso, 2:1, 20 visible and 0 hidden",
    ]
    assert found["parts"] == [["Box"], ["Link/Box"], ["part", "Box"], ["Part/Box", "Link/Box"]]
    assert np.allclose(found["bounds"], [[[100, -10, 0], [110, 0, 10]], [[0, 50, 0], [10, 60, 10]]], atol=1e-5)
    assert len(found["ours"]) == 10
    assert np.allclose(found["ours"], found["theirs"], atol=0.01)
    assert found["saved"] == ""
