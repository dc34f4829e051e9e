"""`hlr batch` as a command."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from batch.models import FakePool, Silent, tetrahedron

from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.batch.report import write
from hlr.batch.run import run
from hlr.cache.store import DRAWINGS, Store


@pytest.fixture
def hlr_batch(tmp_path):
    """Run the command in an empty folder, with a cache of its own."""
    models = tmp_path / "models"
    models.mkdir()

    def command(*arguments, program=("-m", "hlr"), **variables):
        line = [sys.executable, "-P", *program, "batch", *map(str, arguments)]
        env = os.environ | {"HLR_CACHE": str(tmp_path / "cache")} | variables
        return subprocess.run(line, cwd=models, env=env, check=False, capture_output=True, text=True, timeout=120)

    command.folder = models
    return command


@pytest.mark.slow
def test_a_time_limit_costs_the_source_that_takes_longer(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off", 3)
    (hlr_batch.folder / "endless.py").write_text("import cadquery\nresult = 1\nwhile True: pass\n")
    (hlr_batch.folder / "hlr.toml").write_text('views = "iso"\nfiles = ["a.off", "endless.py"]\ntime_limit_s = 500\n')
    done = hlr_batch("--time-limit", "4s")
    assert done.returncode == 1 and "1 drawn, 0 unchanged, 1 failed" in done.stderr
    assert "endless.py took longer than 4 s and was given up; the script itself ran for " in done.stderr
    assert hlr_batch("--list", "--time-limit", "4s").stderr.startswith("hlr: note: --time-limit has no effect: --list")
    assert "is not a time such as 2s" in hlr_batch("--time-limit", "0").stderr


@pytest.mark.slow
def test_a_total_time_limit_ends_the_run_and_the_next_one_goes_on(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off", 3)
    endless = hlr_batch.folder / "endless.py"
    endless.write_text("import cadquery\nresult = 1\nwhile True: pass\n")
    (hlr_batch.folder / "hlr.toml").write_text(
        'views = "iso"\nfiles = ["a.off", "endless.py"]\ntotal_time_limit_s = 500\n'
    )
    time.sleep(0.01)
    done = hlr_batch("--total-time-limit", "6s", "-j", "2")
    assert done.returncode == 1 and "1 drawn, 0 unchanged, 1 failed" in done.stderr
    assert "the time of the batch is up: 1 of 2 sources is not drawn; the next run goes on with it\n" in done.stderr
    report = json.loads((hlr_batch.folder / "drawings/manifest.json").read_text())
    assert [source["state"] for source in report["sources"]] == ["drawn", "failed"]
    assert report["sources"][1]["error"]["kind"] == "TotalTimeLimit"
    endless.write_text("import cadquery\nshow_object(cadquery.Workplane().box(1, 2, 3))\n")
    again = hlr_batch()
    assert again.returncode == 0 and "1 drawn, 1 unchanged, 0 failed" in again.stderr
    listed = hlr_batch("--list", "--total-time-limit", "4s")
    assert listed.stderr.startswith("hlr: note: --total-time-limit has no effect: --list")


@pytest.mark.slow
def test_a_folder_is_drawn_once(hlr_batch, tmp_path):
    for number in range(3):
        tetrahedron(hlr_batch.folder / f"{number}.off", number + 1)
    (hlr_batch.folder / "bad.off").write_text("OFF\n")
    first = hlr_batch("--view", "iso", "-j", "2", GITHUB_ACTIONS="true", GITHUB_WORKSPACE=str(tmp_path))
    assert first.returncode == 1 and "3 drawn, 0 unchanged, 1 failed" in first.stderr
    assert first.stdout.startswith("::error file=models/bad.off,title=bad.off::bad.off ")
    report = json.loads((hlr_batch.folder / "drawings/manifest.json").read_text())
    assert [source["state"] for source in report["sources"]] == ["drawn", "drawn", "drawn", "failed"]
    (hlr_batch.folder / "bad.off").unlink()
    time.sleep(0.01)
    again = hlr_batch("--view", "iso")
    assert again.returncode == 0 and "0 drawn, 3 unchanged, 0 failed" in again.stderr
    assert hlr_batch("--dry-run", "--view", "iso").stdout == "unchanged  0.off\nunchanged  1.off\nunchanged  2.off\n"
    svg = hlr_batch.folder / "drawings/0-iso.svg"
    assert hlr_batch("--list", "--view", "iso", "0.off").stdout == f"{svg}\n"
    # The same bytes as drawn by itself.
    alone = [sys.executable, "-m", "hlr", "draw", "0.off", "-q", "-o", "alone.svg"]
    subprocess.run(alone, cwd=hlr_batch.folder, check=True)
    assert (hlr_batch.folder / "alone.svg").read_bytes() == svg.read_bytes()


@pytest.mark.slow
def test_a_run_without_work_loads_nothing_heavy(hlr_batch, tmp_path):
    folder = hlr_batch.folder
    for number in range(100):
        model = tetrahedron(folder / f"{number}.off", number + 1)
        os.utime(model, (0, 0))
    # As if they had been drawn: what counts is the run after that.
    store, digests = Store(tmp_path / "cache", 10**9, DRAWINGS), Digests()
    asked = plan(manifest_of({"views": ["iso"]}, folder), folder / "drawings")
    write(run(asked, Kept(store, digests), FakePool(), Silent()), digests, {})
    code = (
        "import atexit, os, sys\n"
        "from hlr.cli import main\n"
        "atexit.register(lambda: print(sum(os.times()[:4]), *sys.modules))\n"
        "main()\n"
    )
    done = hlr_batch("--view", "iso", program=("-c", code))
    assert "0 drawn, 100 unchanged, 0 failed" in done.stderr
    seconds, *modules = done.stdout.split()
    assert not {"numpy", "OCP", "rich", "psutil", "subprocess", "hlr._kernel"} & set(modules)
    assert float(seconds) < 1.0


@pytest.mark.slow
def test_the_manifest_is_followed_and_what_is_wrong_refused(hlr_batch):
    tetrahedron(hlr_batch.folder / "parts/a.off")
    assert hlr_batch("--init").returncode == 0
    manifest = hlr_batch.folder / "hlr.toml"
    assert 'files = ["**/*.off"]' in manifest.read_text()
    assert hlr_batch("--init").returncode == 2
    manifest.write_text('output = "out"\nviews = ["iso"]\nformats = ["json"]\n\ncrease = 400\n')
    wrong = hlr_batch()
    assert wrong.returncode == 2 and wrong.stderr.startswith("hlr: hlr.toml, line 5, crease: crease 400 is not a")
    manifest.write_text(manifest.read_text().replace("400", "40"))
    assert hlr_batch("-q").stderr == ""
    assert (hlr_batch.folder / "out/parts/a-iso.json").exists()
    # The folder itself may be a file.
    (hlr_batch.folder / "file").touch()
    refused = hlr_batch("-o", "file")
    path = hlr_batch.folder / "file"
    assert refused.returncode == 2 and refused.stderr == f"hlr: cannot write into {path}: {path} is not a folder.\n"
    assert hlr_batch("-o", "file/in").stderr == f"hlr: cannot write into {path}/in: {path} is not a folder.\n"


@pytest.mark.slow
def test_strict_names_the_source_and_why_nothing_is_written(hlr_batch):
    (hlr_batch.folder / "ä ö.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    said = hlr_batch("--strict", "--view", "top").stderr.splitlines()[0]
    assert said == (
        '1/1 ä ö.off: failed: ä ö.off: Part "ä ö" is drawn as it is: open: 3 border edges; nothing is written, because '
        "warnings are errors (strict)."
    )
    assert not list((hlr_batch.folder / "drawings").glob("*.svg"))


@pytest.mark.slow
def test_a_cache_that_cannot_be_written_is_told_once(hlr_batch, tmp_path):
    (tmp_path / "file").touch()
    for name in ("a.off", "b.off"):
        tetrahedron(hlr_batch.folder / name)
    for _ in range(2):
        done = hlr_batch("--view", "top", HLR_CACHE=str(tmp_path / "file"))
        assert done.returncode == 0 and "2 drawn, 0 unchanged, 0 failed" in done.stderr
        assert [line for line in done.stderr.splitlines() if "note" in line] == [
            "hlr: note: the next run draws again what it should find in the cache: it cannot be kept "
            f"({tmp_path / 'file'}: file exists)."
        ]
    assert "note" not in hlr_batch("--view", "top", HLR_CACHE="off").stderr
    assert hlr_batch("--view", "top", "-q", HLR_CACHE=str(tmp_path / "file")).stderr == ""


@pytest.mark.slow
def test_a_report_that_cannot_be_written_says_what_is_drawn(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    code = (
        "import hlr.batch.report\n"
        "from hlr.cli import main\n"
        "from hlr.errors import WriteError\n"
        "def full(*_):\n"
        "    raise WriteError('cannot write junit.xml: no space left on device.')\n"
        "hlr.batch.report.write = full\n"
        "main()\n"
    )
    done = hlr_batch("--view", "iso", program=("-c", code))
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1] == (
        "hlr: cannot write junit.xml: no space left on device; what is drawn stays, but there is no new report "
        "(1 drawn, 0 unchanged, 0 failed)."
    )


@pytest.mark.slow
def test_ctrl_c_says_how_far_it_has_come(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "endless.py").write_text("while True: pass\n")
    command = [sys.executable, "-P", "-m", "hlr", "batch", "a.off", "endless.py", "--view", "top", "-j", "2"]
    process = subprocess.Popen(command, cwd=hlr_batch.folder, stderr=subprocess.PIPE, text=True)
    assert process.stderr.readline().startswith("1/2 a.off: 1 view, ")
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=10) == -signal.SIGINT
    assert process.stderr.read() == "stopped: 1 of 2 sources are done; there is no new report\n"
    assert [path.name for path in (hlr_batch.folder / "drawings").iterdir()] == ["a-top.svg"]


@pytest.mark.slow
def test_watching_draws_what_is_saved(hlr_batch, tmp_path):
    model, svg = tetrahedron(hlr_batch.folder / "a.off"), hlr_batch.folder / "drawings/a-iso.svg"
    command = [sys.executable, "-P", "-m", "hlr", "batch", "--watch", "--view", "iso"]
    process = subprocess.Popen(command, cwd=hlr_batch.folder, stderr=subprocess.PIPE, text=True)
    try:
        for line in process.stderr:
            if line.startswith("watching"):
                break
        time.sleep(0.3)  # the watcher itself starts after that line
        before = svg.read_bytes()
        tetrahedron(model, 25)
        end = time.monotonic() + 20.0
        while svg.read_bytes() == before:
            assert time.monotonic() < end
            time.sleep(0.02)
        # What no drawing depends on, as a log of what is said here, starts nothing.
        time.sleep(0.3)
        (hlr_batch.folder / "watch.log").write_text("a line\n")
        time.sleep(0.5)
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=10) == -signal.SIGINT
    assert sum(" drawn, " in line for line in process.stderr) == 1


def test_a_manifest_that_is_not_used_is_told(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "hlr.toml").write_text('views = "left"\n')
    listed = hlr_batch("a.off", "--list")
    assert listed.stderr.startswith("hlr: note: hlr.toml is not used, for sources are named")
    assert "a-front.svg" in listed.stdout
    assert hlr_batch("a.off", "--list", "-q").stderr == hlr_batch("--list").stderr == ""


def test_an_option_that_no_source_has_a_use_of_is_told(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "b.step").touch()
    manifest = hlr_batch.folder / "hlr.toml"
    # One source that it is for is enough.
    manifest.write_text("circles = true\nannotations = true\nseam = true\n")
    assert hlr_batch("--list").stderr == ""
    manifest.write_text("circles = true\nannotations = true\nfiles = 'b.step'\n")
    assert hlr_batch("--list").stderr == (
        "hlr: note: circles in hlr.toml has no effect but on shapes that are made of triangles alone: "
        "it is for meshes, and none of its sources is such.\n"
    )
    manifest.write_text("[[source]]\nfiles = 'a.off'\nseam = true\n[[source]]\nfiles = 'b.step'\n")
    told = hlr_batch("--list").stderr
    assert told == "hlr: note: seam in hlr.toml has no effect: it is for CAD models, and none of its sources is such.\n"
    assert hlr_batch("--list", "-q").stderr == ""


def test_a_page_of_a_document_is_refused_with_the_command_that_draws_it(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "b c.FCStd").touch()
    manifest = hlr_batch.folder / "hlr.toml"
    manifest.write_text('views = "iso"\npage = "Page"\n')
    refused = hlr_batch()
    assert (refused.returncode, refused.stderr) == (
        2,
        "hlr: hlr.toml, line 2, page: a sheet such as A3 is needed, not 'Page': batches draw no TechDraw pages; "
        "hlr draw 'b c.FCStd' --page Page draws one.\n",
    )
    # Of sources that have no pages the usual sentence lists the sheets.
    manifest.write_text('files = "a.off"\npage = "A44"\n')
    assert "no page is called 'A44': use A0, A1" in hlr_batch().stderr


@pytest.mark.parametrize("named", [("my.toml", "a.off"), ("a.off", "my.toml"), ("my.toml", "my.toml")])
def test_a_manifest_and_sources_are_not_named_together(hlr_batch, named):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "my.toml").write_text('views = "iso"\n')
    refused = hlr_batch(*named)
    assert (refused.returncode, refused.stderr) == (
        2,
        "hlr: my.toml is a manifest, which names its sources itself: give it alone, or leave it out.\n",
    )
    assert hlr_batch("my.toml", "--list").stdout.endswith("a-iso.svg\n")


def test_ways_not_to_draw_contradict_one_another(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    refused = hlr_batch("--list", "--watch")
    assert refused.returncode == 2 and "contradict one another: give one of them" in refused.stderr


def test_the_command_line_wins_over_each_table_of_a_manifest(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off")
    (hlr_batch.folder / "hlr.toml").write_text('[[source]]\nfiles = "a.off"\nviews = "iso"\nformats = "pdf"\n')
    assert hlr_batch("--list").stdout.split() == [str(hlr_batch.folder / "drawings/a-iso.pdf")]
    given = hlr_batch("--list", "--view", "front", "--format", "svg")
    assert given.stdout.split() == [str(hlr_batch.folder / "drawings/a-front.svg")]


@pytest.mark.slow
def test_a_change_since_the_baseline_is_exit_code_3(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off", 1)
    assert hlr_batch("--view", "iso", "-o", "old").returncode == 0
    same = hlr_batch("--view", "iso", "--baseline", "old", "--fail-on-change")
    assert same.returncode == 0 and "since old: 1 unchanged, 0 changed, 0 new, 0 gone" in same.stderr
    tetrahedron(hlr_batch.folder / "a.off", 3)
    assert hlr_batch("--view", "iso", "--baseline", "old").returncode == 0
    assert hlr_batch("--view", "iso", "--baseline", "old", "-q").stderr == ""
    failed = hlr_batch("--view", "iso", "--baseline", "old", "--fail-on-change", "-q")
    assert (failed.returncode, failed.stderr) == (3, "since old: 0 unchanged, 1 changed, 0 new, 0 gone\n")
    refused = hlr_batch("--fail-on-change")
    assert refused.returncode == 2 and refused.stderr.startswith("hlr: --fail-on-change needs --baseline")


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("fit = 'A4'", "fit: only a view by itself has fit: leave out fit, or arrange."),
    ],
)
def test_what_an_arranged_page_cannot_have_is_refused_before_any_work(hlr_batch, keys, words):
    tetrahedron(hlr_batch.folder / "part.off", 1)
    (hlr_batch.folder / "hlr.toml").write_text(f"arrange = 'third-angle'\n{keys}\n")
    done = hlr_batch()
    assert done.returncode == 2
    assert f"hlr.toml, line 2, {words}" in done.stderr
    assert not list(hlr_batch.folder.rglob("*.svg"))


def test_a_baseline_without_a_name_is_refused(hlr_batch):
    tetrahedron(hlr_batch.folder / "part.off", 1)
    done = hlr_batch("part.off", "--baseline", "")
    assert done.returncode == 2 and done.stderr.startswith("hlr: the name of the baseline is empty: name ")
    assert [path.name for path in hlr_batch.folder.rglob("*")] == ["part.off"]


def test_an_arranged_page_on_the_command_line(hlr_batch):
    tetrahedron(hlr_batch.folder / "part.off", 1)
    done = hlr_batch("part.off", "--arrange", "first-angle", "--list")
    assert [line.rpartition("/")[2] for line in done.stdout.split()] == ["part-first-angle.svg"]


@pytest.mark.slow
def test_an_arranged_page_as_json(hlr_batch):
    tetrahedron(hlr_batch.folder / "part.off", 1)
    done = hlr_batch("part.off", "--arrange", "first-angle", "--format", "json")
    assert done.returncode == 0, done.stderr
    assert done.stderr.startswith("1/1 part.off: 1 page, ")
    found = json.loads((hlr_batch.folder / "drawings/part-first-angle.json").read_text("utf-8"))
    assert [view["name"] for view in found["views"]] == ["front", "top", "left", "iso"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a file that is always full")
def test_a_list_that_cannot_be_printed_is_told_in_a_sentence(hlr_batch):
    tetrahedron(hlr_batch.folder / "a.off", 3)
    line = [sys.executable, "-P", "-m", "hlr", "batch", "--list"]
    with open("/dev/full", "wb") as full:
        done = subprocess.run(line, cwd=hlr_batch.folder, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == "hlr: cannot write to standard output: no space left on device.\n"
