"""`--time-limit` of every verb that may take long: what took the time is said, and what helps."""

import os
import re
import subprocess
import sys

import pytest

from hlr.common.stage_times import StageTimes
from hlr.tables.readers import READERS, of_ending
from hlr.tables.stages import STAGES, given_up
from support.fake_pipeline import PROGRAM
from support.programs import environment

HLR = [sys.executable, "-P", "-m", "hlr"]
SCRIPT, STEP = of_ending(".py"), of_ending(".step")


def sentence(stage, reader=STEP, coarser="ask for a larger --accuracy"):
    return given_up("a.x", reader, 60.0, (stage, 41.26), "--time-limit", coarser)


def test_what_took_the_time_is_said_and_what_helps():
    assert sentence("source", SCRIPT) == (
        "a.x took longer than 60 s and was given up; the script itself ran for 41 s of that: "
        "raise --time-limit, or make the script faster"
    )
    assert sentence("source").endswith("given up; reading it took 41 s of that: raise --time-limit")
    for stage in ("tessellate", "scene", "visibility", "linework", "measure", "compare"):
        assert sentence(stage).endswith(" took 41 s of that: raise --time-limit, or ask for a larger --accuracy")
        assert sentence(stage, SCRIPT) == sentence(stage)
        assert sentence(stage, coarser="").endswith(" took 41 s of that: raise --time-limit")
    assert sentence("FreeCAD").endswith("raise --time-limit, or take its coarse view (--coarse)")
    assert sentence("depth sort").endswith("the work took 41 s of that: raise --time-limit")
    assert len({sentence(stage) for stage in STAGES}) == len(STAGES)
    told = [
        given_up("a.x", STEP, 0.01, ("source", seconds), "--time-limit", "") for seconds in (0.0123, 0.57, 9.94, 9.96)
    ]
    assert [re.search(r"took (\S+) s of", each)[1] for each in told] == ["0.01", "0.6", "9.9", "10"]


def test_the_longest_stage_is_told(monkeypatch):
    now = 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    times = StageTimes()
    for now, stage in ((1.0, "source"), (5.0, "tessellate"), (8.0, "visibility"), (10.0, "tessellate")):  # noqa: B007
        times.begin(stage)
    assert times.stage == "tessellate"
    now = 10.5
    assert times.longest() == ("source", 4.0)
    now = 11.25
    assert times.longest() == ("tessellate", 4.25)


@pytest.fixture
def ended(tmp_path):
    """Run the command line, which is given up: what it says."""
    if not hasattr(os, "fork"):
        pytest.skip("there is no worker without fork")

    def run(program, *arguments):
        done = subprocess.run(
            [*program, *arguments],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=30,
            check=False,
            env=environment(),
        )
        assert (done.returncode, done.stdout) == (2, ""), done.stderr
        return done.stderr

    return run


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [
        ("preview", "part.py"),
        ("plan", "part.py"),
        ("info", "part.py"),
        ("methods", "part.py"),
        ("compare", "part.off", "part.py", "--view", "front"),
    ],
)
def test_a_script_without_end(arguments, ended, tmp_path):
    (tmp_path / "part.py").write_text("while True: pass\n")
    (tmp_path / "part.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    assert re.fullmatch(
        r"hlr: part\.py took longer than 1\.5 s and was given up; the script itself ran for [01]\.\d s of that: raise "
        r"--time-limit, or make the script faster\.\n",
        ended(HLR, *arguments, "--time-limit", "1500ms"),
    )
    assert {path.name for path in tmp_path.iterdir()} == {"part.py", "part.off"}


def test_lines_that_take_long(ended, tmp_path):
    assert re.fullmatch(
        r"hlr: slow\.step took longer than 1 s and was given up; finding what hides its lines took (0\.\d|1\.0) s of "
        r"that: raise --time-limit, or ask for a larger --accuracy\.\n",
        ended(PROGRAM, "draw", "slow.step", "--time-limit", "1s"),
    )
    assert list(tmp_path.iterdir()) == []


# The command line with a comparison that reads for so many seconds, and compares without end.
COMPARES = """
import time
import hlr.compare
def compare(*sides, progress, **more):
    progress("source", 0.0)
    time.sleep({reads})
    progress("compare", 0.0)
    time.sleep(60)
hlr.compare.compare = compare
from hlr.cli import main
main()
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("reads", "words"),
    [
        (0.0, r"comparing the lines took [12]\.\d s of that: raise --time-limit, or ask for a larger --tolerance"),
        (1.6, r"reading it took 1\.[6-9] s of that: raise --time-limit"),
    ],
)
def test_two_drawings_have_a_limit_as_well(reads, words, ended, tmp_path):
    for name in ("a.svg", "b.svg"):
        (tmp_path / name).write_text("<svg/>")
    program = [sys.executable, "-P", "-c", COMPARES.format(reads=reads)]
    said = ended(program, "compare", "a.svg", "b.svg", "--time-limit", "2.5s")
    assert re.fullmatch(rf"hlr: a\.svg took longer than 2\.5 s and was given up; {words}\.\n", said), said


def test_every_reader_has_a_kind_that_the_sentence_knows():
    assert [reader.title for reader in READERS.values() if reader.kind == "script"] == [SCRIPT.title]
