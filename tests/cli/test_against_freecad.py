"""`hlr compare --against freecad`: one sentence where there is no FreeCAD, the usual answer where there is one."""

import json
import os
import re
import signal
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from support.installed_freecad import needs_freecad

SCREW = str(Path(__file__).parents[1] / "data" / "M6-1x12-countersunk-screw.step")


def test_what_is_refused_is_two(hlr_real, monkeypatch):
    monkeypatch.setenv("HLR_FREECAD", "no-such-program")
    for arguments in ((SCREW,), (SCREW, SCREW), (SCREW, "--page", "Page"), ("none.step",)):
        result = hlr_real("compare", "--against", "freecad", *arguments)
        assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)


@pytest.fixture
def endless(tmp_path):
    """A program in the place of FreeCAD that says so and goes on; variables that lead to it, and to an empty folder."""
    if not hasattr(os, "fork"):
        pytest.skip("there is no worker without fork")
    program = tmp_path / "freecadcmd"
    program.write_text("#!/bin/sh\necho started > ../../started\nexec sleep 60\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    (tmp_path / "made").mkdir()
    return os.environ | {"HLR_FREECAD": str(program), "TMPDIR": str(tmp_path / "made"), "HLR_CACHE": "off"}


COMPARE = [
    sys.executable,
    "-P",
    "-m",
    "hlr",
    "compare",
    "--against",
    "freecad",
    SCREW,
    "--view",
    "front",
    "--scale",
    "1",
]


@pytest.mark.slow
def test_nothing_is_left_behind_after_ctrl_c(endless, tmp_path, started):
    process = started(COMPARE, env=endless, stderr=subprocess.PIPE)
    end = time.monotonic() + 20.0
    while not (tmp_path / "started").exists() and time.monotonic() < end:
        time.sleep(0.02)
    assert len(list((tmp_path / "made").iterdir())) == 1
    process.send_signal(signal.SIGINT)
    assert process.wait(5) == -signal.SIGINT
    assert list((tmp_path / "made").iterdir()) == [] and process.stderr.read() == b""


@pytest.mark.slow
def test_a_time_limit_holds_for_freecad_as_well(endless, tmp_path):
    done = subprocess.run([*COMPARE, "--time-limit", "8s"], env=endless, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert re.fullmatch(
        r"hlr: M6-1x12-countersunk-screw\.step took longer than 8 s and was given up; FreeCAD's own drawing took "
        r"[1-8]\.\d s of that: raise --time-limit, or take its coarse view \(--coarse\)\.\n",
        done.stderr,
    )
    assert list((tmp_path / "made").iterdir()) == []


def test_without_a_worker_the_limit_is_that_of_freecad(endless, hlr_real, monkeypatch):
    for name in ("HLR_FREECAD", "TMPDIR", "HLR_CACHE"):
        monkeypatch.setenv(name, endless[name])
    result = hlr_real(*COMPARE[4:], "--time-limit", "0.5s")
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("hlr: FreeCAD did not draw M6-1x12-countersunk-screw.step in 0.5 s: give it more time")


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
