"""An installed FreeCAD draws the other side: what is told where it is missing, hangs, crashes or draws nothing."""

import json
import os
import stat
import sys
import time

import pytest

import hlr
from hlr.compare.freecad import compare_with_freecad, drawn_by_freecad
from hlr.errors import OptionError, SourceError
from support.installed_freecad import needs_freecad
from support.models import box

SCREW = os.path.join(os.path.dirname(__file__), "..", "data", "M6-1x12-countersunk-screw.step")


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """Makes a program take the place of FreeCAD."""

    def put(body):
        program = tmp_path / "freecadcmd"
        program.write_text(f"#!{sys.executable}\nimport json, os, sys, time, signal, subprocess\n{body}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        monkeypatch.setenv("HLR_FREECAD", str(program))
        return program

    return put


def test_a_missing_freecad_is_told_in_one_sentence(monkeypatch):
    monkeypatch.setenv("HLR_FREECAD", "no-such-program")
    with pytest.raises(OptionError, match="FreeCAD is not installed: HLR_FREECAD names no-such-program"):
        drawn_by_freecad(SCREW, "front")
    monkeypatch.delenv("HLR_FREECAD")
    monkeypatch.setenv("PATH", "")
    with pytest.raises(OptionError, match="FreeCAD is not installed: no freecadcmd is on the path"):
        drawn_by_freecad(SCREW, "front")


def test_all_that_freecad_started_is_ended_when_its_time_is_over(stand_in, tmp_path):
    note = tmp_path / "child"
    child = f"import os, time; open({str(note)!r}, 'w').write(str(os.getpid())); time.sleep(60)"
    stand_in(f"subprocess.Popen([sys.executable, '-c', {child!r}])\ntime.sleep(60)")
    started = time.monotonic()
    with pytest.raises(SourceError, match=r"did not draw M6-1x12-countersunk-screw\.step in 1 s"):
        drawn_by_freecad(SCREW, "front", time_limit_s=1.0)
    assert time.monotonic() - started < 10.0
    deadline = time.monotonic() + 5.0
    while _runs(int(note.read_text())) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _runs(int(note.read_text()))


def _runs(number):
    """Whether a process runs; one that has ended and that nobody has waited for does not."""
    try:
        with open(f"/proc/{number}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("os.kill(os.getpid(), signal.SIGKILL)", "FreeCAD crashed while it drew .* .signal 9"),
        ("sys.exit(1)", "ended without a drawing"),
        (
            "job = json.load(open(os.environ['HLR_JOB']))\nopen(job['answer'], 'w').write('{')",
            "ended without a drawing",
        ),
        (
            "job = json.load(open(os.environ['HLR_JOB']))\n"
            "json.dump({'svg': '', 'seconds': 0, 'version': '1.0'}, open(job['answer'], 'w'))",
            "drew no line",
        ),
    ],
)
def test_what_goes_wrong_there_is_told_in_one_sentence(body, said, stand_in):
    stand_in(body)
    with pytest.raises(SourceError, match=said):
        drawn_by_freecad(SCREW, "front")


def test_the_view_goes_over(stand_in, tmp_path):
    stand_in(f"import shutil\nshutil.copy(os.environ['HLR_JOB'], {str(tmp_path / 'job.json')!r})")
    with pytest.raises(SourceError):
        drawn_by_freecad(SCREW, "iso", scale=0.5, coarse=True)
    job = json.loads((tmp_path / "job.json").read_text())
    assert job["model"] == os.path.realpath(SCREW) and (job["scale"], job["coarse"]) == (0.5, True)
    assert job["direction"] == pytest.approx([3**-0.5, -(3**-0.5), 3**-0.5])
    assert job["right"] == pytest.approx([2**-0.5, 2**-0.5, 0.0])


def test_a_script_is_run_once_and_goes_over_as_chosen(stand_in, tmp_path):
    pytest.importorskip("cadquery")
    script = tmp_path / "part.py"
    script.write_text(
        f"import cadquery as cq\nsize = 1\nopen({str(tmp_path / 'runs')!r}, 'a').write(f'{{size}}\\n')\n"
        "show_object(cq.Workplane().box(1, 2, size), 'plate')\nshow_object(cq.Workplane().sphere(9), 'ball')\n"
    )
    stand_in(
        f"import shutil\nshutil.copy(json.load(open(os.environ['HLR_JOB']))['model'], {str(tmp_path / 'm.brep')!r})"
    )
    with pytest.raises(SourceError, match=r"ended without a drawing of part\.py"):
        compare_with_freecad(script, "front", only=["plate"], parameters={"size": 3})
    assert (tmp_path / "runs").read_text() == "3\n"
    bounds = hlr.info(tmp_path / "m.brep").bounds
    assert [high - low for low, high in zip(*bounds, strict=True)] == pytest.approx([1, 2, 3])


def test_of_a_file_that_freecad_reads_itself_chosen_parts_go_over(stand_in, tmp_path):
    stand_in(f"import shutil\nshutil.copy(os.environ['HLR_JOB'], {str(tmp_path / 'job.json')!r})")
    for chosen, read in (({}, True), ({"only": ["*screw*"]}, False)):
        with pytest.raises(SourceError):
            compare_with_freecad(SCREW, "front", scale=1.0, **chosen)
        assert (json.loads((tmp_path / "job.json").read_text())["model"] == os.path.realpath(SCREW)) == read


def test_meshes_are_refused(stand_in):
    stand_in("")
    with pytest.raises(SourceError, match="is a mesh"):
        drawn_by_freecad(box((1, 2, 3)), "front")


@needs_freecad
@pytest.mark.slow
def test_a_box_with_a_hole_is_the_same_in_both():
    import cadquery as cq

    made = cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(5)
    for coarse in (False, True):
        assert compare_with_freecad(made, "front", coarse=coarse).same
