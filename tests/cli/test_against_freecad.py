"""`hlr compare --against freecad`: one sentence where there is no FreeCAD, the usual answer where there is one."""

import json
from pathlib import Path

import pytest

from support.installed_freecad import needs_freecad

SCREW = str(Path(__file__).parents[1] / "data" / "M6-1x12-countersunk-screw.step")


def test_what_is_refused_is_two(hlr_real, monkeypatch):
    monkeypatch.setenv("HLR_FREECAD", "no-such-program")
    for arguments in ((SCREW,), (SCREW, SCREW), (SCREW, "--page", "Page"), ("none.step",)):
        result = hlr_real("compare", "--against", "freecad", *arguments)
        assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)


@needs_freecad
@pytest.mark.slow
def test_both_are_compared(hlr_real, tmp_path):
    out = tmp_path / "d.json"
    result = hlr_real(
        "compare", "--against", "freecad", SCREW, "--view", "right", "--coarse", "--scale", "1", "-o", str(out)
    )
    found = json.loads(out.read_text())
    assert result.code in (0, 1) and result.err == "", result
    assert found["before"].startswith("FreeCAD ") and found["before"].endswith(", coarse.svg")
    assert found["after"] == "M6-1x12-countersunk-screw.step, right" and found["same_mm"] > 10.0
