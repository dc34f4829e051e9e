"""build123d's objects, drawn without CadQuery: on the bindings of OpenCASCADE 7 or 8, whichever build123d brings."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

bd = pytest.importorskip("build123d")

SCRIPT = "from build123d import *\nwith BuildPart() as part:\n    Box(40, 30, 20)\n    Hole(5)\n"


def ink(drawing: hlr.Drawing) -> float:
    """Millimetres of visible lines."""
    return sum(float(np.hypot(*np.diff(line.points, axis=0).T).sum()) for line in drawing.lines if line.visible)


def test_shapes_of_known_outlines() -> None:
    assert ink(hlr.draw(bd.Sphere(10), "iso", **AT_SIZE)) == pytest.approx(20 * math.pi, abs=0.05)
    assert ink(hlr.draw(bd.Box(10, 20, 30), "front", hidden=False, scale=1.0, smooth=False)) == pytest.approx(
        2 * (10 + 30), abs=1e-6
    )
    plate = bd.Box(40, 30, 20) - bd.Cylinder(5, 20)
    assert ink(hlr.draw(plate, "top", hidden=False, scale=1.0, smooth=False)) == pytest.approx(
        2 * (40 + 30) + 10 * math.pi, abs=0.05
    )


@pytest.mark.parametrize("suffix", [".step", ".brep"])
def test_its_files_are_read(tmp_path: Path, suffix: str) -> None:
    shape = bd.Box(40, 30, 20) - bd.Cylinder(5, 20)
    {".step": bd.export_step, ".brep": bd.export_brep}[suffix](shape, str(tmp_path / f"plate{suffix}"))
    drawn, read = hlr.draw(shape, "iso", **AT_SIZE), hlr.draw(tmp_path / f"plate{suffix}", "iso", **AT_SIZE)
    assert ink(read) == pytest.approx(ink(drawn), abs=1e-6)


@pytest.mark.slow
def test_a_script_and_an_assembly_with_colours(tmp_path: Path) -> None:
    (tmp_path / "part.py").write_text(SCRIPT)
    command = [sys.executable, "-P", "-m", "hlr", "draw", "part.py", "-o", "part.svg"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "part.svg").read_text().count("<path") + (tmp_path / "part.svg").read_text().count("<circle") > 1
    one, other = bd.Box(10, 10, 10), bd.Pos(0, 0, 10) * bd.Box(5, 5, 10)
    one.label, other.label, other.color = "foot", "mast", bd.Color(1, 0, 0)
    drawing = hlr.draw(bd.Compound(children=[one, other]), "iso", fill=True, **AT_SIZE)
    assert [part.name for part in drawing.parts] == ["foot", "mast"]
