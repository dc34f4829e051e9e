"""A batch beside earlier drawings: what changed is named, by geometry; folders and git alike; hostile names refused."""

import json
import subprocess

import pytest
from batch.models import FakePool, Silent, tetrahedron

from hlr.batch.baseline import baseline_of
from hlr.batch.changes import changes
from hlr.batch.job import Outcome
from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.batch.pool import Event
from hlr.batch.report import write
from hlr.batch.run import run
from hlr.errors import OptionError
from support.drawings import drawing, line

BOX = [line([[0, 0], [30, 0]]), line([[30, 0], [30, 20]], edge=7)]
LONGER = [line([[0, 0], [30, 0]]), line([[30, 0], [30, 25]], edge=7)]
SPLIT = [line([[12, 0], [0, 0]]), line([[12, 0], [30, 0]]), BOX[1]]


class Draws(FakePool):
    """Draws these lines of every source, by its name."""

    def __init__(self, **lines):
        super().__init__()
        self.lines = lines

    def run(self, jobs, *limits):
        for event in super().run(jobs, *limits):
            if event.outcome is not None and event.outcome.failure is None:
                job = jobs[event.number]
                made = drawing(self.lines[job.source.partition(".")[0]]).to_svg().encode()
                yield Event(event.number, outcome=Outcome(None, event.outcome.drawings, ((made,),)))
            else:
                yield event


@pytest.fixture
def go(tmp_path):
    """Draw the models of the folder with these lines each: the report."""

    def go(baseline=None, output="out", **lines):
        for path in tmp_path.glob("*.off"):
            path.unlink()
        for name in lines:
            tetrahedron(tmp_path / f"{name}.off")
        digests = Digests()
        asked = plan(manifest_of({"views": ["top"], "files": "*.off"}, tmp_path), tmp_path / output)
        earlier = None if baseline is None else baseline_of(str(baseline), asked)
        done = run(asked, Kept(None, digests), Draws(**lines), Silent())
        found = None if earlier is None else changes(done, earlier)
        return write(done, digests, {}, found)

    return go


def git(folder, *arguments):
    who = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false")
    subprocess.run(["git", "-C", str(folder), *who, *arguments], check=True, capture_output=True)


def told(report):
    return {source["source"]: source["drawings"][0]["change"] for source in report["sources"]}


@pytest.fixture(params=["folder", "git"])
def earlier(request, go, tmp_path):
    """The drawings of four models, as a folder beside or as a revision: what names them."""
    before = {"alike": BOX, "split": BOX, "longer": BOX, "lost": BOX}
    if request.param == "folder":
        go(output="old", **before)
        return tmp_path / "old"
    go(**before)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-qm", "drawn")
    git(tmp_path, "tag", "v1")
    return "git:v1"


def test_what_changed_since_the_baseline(go, earlier, tmp_path):
    report = go(earlier, alike=BOX, split=SPLIT, longer=LONGER, added=BOX)
    found = told(report)
    assert {name: change["state"] for name, change in found.items()} == {
        "added.off": "new",
        "alike.off": "unchanged",
        "longer.off": "changed",
        "split.off": "unchanged",
    }
    changed = found["longer.off"]
    assert changed["summary"] == "5 mm new" and changed["mm"]["new"] == 5.0 and changed["mm"]["gone"] == 0.0
    assert (tmp_path / "out" / changed["before"]).read_text().startswith("<?xml")
    assert "new, 5 mm" in (tmp_path / "out" / changed["overlay"]).read_text()
    assert all("before" not in found[name] and "overlay" not in found[name] for name in found if name != "longer.off")
    assert report["gone"] == ["lost-top.svg"] and report["counts"]["changed"] == 2
    assert json.loads((tmp_path / "out/manifest.json").read_text()) == report
    summary = (tmp_path / "out/summary.md").read_text()
    assert "| longer-top.svg | changed | 5 mm new |" in summary and "| lost-top.svg | gone |" in summary
    assert {path.name for path in (tmp_path / "out/baseline").iterdir()} == {
        "longer-top.svg",
        "longer-top.svg.overlay.svg",
    }


def test_a_part_that_grows_to_the_left_has_not_moved(go, tmp_path):
    # Drawings begin at their lower left corner: all lines lie elsewhere in the file.
    grown = [line([[8, 0], [38, 0]]), line([[38, 0], [38, 20]], edge=7), line([[0, 0], [8, 0]])]
    go(output="old", a=BOX)
    change = told(go(tmp_path / "old", a=grown))["a.off"]
    assert change["summary"] == "8 mm new; moved by (-8, 0) mm to be compared"
    assert change["mm"] == {**dict.fromkeys(change["mm"], 0.0), "new": 8.0}


def test_without_a_baseline_there_is_no_change(go):
    report = go(alike=BOX)
    assert "gone" not in report and "change" not in report["sources"][0]["drawings"][0]


def test_an_earlier_drawing_that_is_none_of_ours_has_changed(go, tmp_path):
    (tmp_path / "old").mkdir()
    (tmp_path / "old/alike-top.svg").write_text('<!DOCTYPE svg [<!ENTITY a "b">]><svg>&a;</svg>')
    change = told(go(tmp_path / "old", alike=BOX))["alike.off"]
    assert change["state"] == "changed" and "declares XML entities" in change["summary"]


@pytest.mark.parametrize("folder", ["out/baseline", "out/baseline/sub", "out/sub"])
def test_a_baseline_that_would_be_overwritten_is_refused(folder, tmp_path):
    tetrahedron(tmp_path / "sub/c.off")
    asked = plan(manifest_of({"views": ["top"], "files": "sub/c.off"}, tmp_path), tmp_path / "out")
    for each in (folder, "out/old"):
        (tmp_path / each).mkdir(parents=True)
    (tmp_path / "link").symlink_to(tmp_path / folder)
    for name in (tmp_path / folder, tmp_path / "link"):
        with pytest.raises(OptionError, match="would be overwritten: copy it out of the folder of outputs first"):
            baseline_of(str(name), asked)
    assert baseline_of(str(tmp_path / "out/old"), asked).names() == frozenset()


@pytest.mark.parametrize(
    "name",
    ["none", "out", "git:", "git:none", "git:--output=x", "git:v1\n", "git:v1^{/x}", "git:HEAD:out", "git:v1..v1"],
)
def test_a_baseline_that_is_none_is_refused_in_one_sentence(name, go, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    go(alike=BOX)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-qm", "drawn")
    git(tmp_path, "tag", "v1")
    before = set(tmp_path.rglob("*"))
    with pytest.raises(OptionError, match="baseline"):
        go(name, alike=BOX)
    assert {path for path in tmp_path.rglob("*") if ".git" not in path.parts} <= before


def test_a_folder_that_is_no_repository_is_refused(go):
    with pytest.raises(OptionError, match="git:main"):
        go("git:main", alike=BOX)


def test_links_in_a_revision_lead_nowhere(go, tmp_path):
    secret = tmp_path.parent / "secret.svg"
    secret.write_text("secret")
    (tmp_path / "out").mkdir()
    (tmp_path / "out/alike-top.svg").symlink_to(secret)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-qm", "linked")
    (tmp_path / "out/alike-top.svg").unlink()
    assert told(go("git:HEAD", alike=BOX))["alike.off"]["state"] == "new"
