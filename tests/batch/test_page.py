"""The web page of a batch: which files it has, when they are written, and that no name becomes markup."""

import base64
import re
import zlib

from batch.models import FakePool, Silent, tetrahedron
from batch.reports import drawing, report, source, written

from hlr.batch.kept import Kept
from hlr.batch.keys import Digests
from hlr.batch.manifest import manifest_of
from hlr.batch.page.cards import cards
from hlr.batch.page.scripts import data
from hlr.batch.plan import plan
from hlr.batch.report import write
from hlr.batch.run import run
from hlr.batch.stale import earlier

HOSTILE = "</script><script>alert(1)</script>\"'<img src=x onerror=alert(2)>&.step"


def scripts_of(page):
    return {path.name: path for path in (page.parent / "page/drawings").iterdir()}


def state_of(folder):
    return {path: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.rglob("*") if path.is_file()}


def test_a_batch_has_a_page(tmp_path):
    tetrahedron(tmp_path / "a.off")
    asked = plan(manifest_of({"views": ["iso", "top"]}, tmp_path), tmp_path / "out")
    write(run(asked, Kept(None, Digests()), FakePool(), Silent()), Digests(), {})
    page = tmp_path / "out/index.html"
    assert page.read_text().count('<li class="card"') == 2
    linked = re.findall(r'(?:src|href)="((?:page/|\./)[^"]+)"', page.read_text())
    assert linked and all((page.parent / link).is_file() for link in linked)
    for path in scripts_of(page).values():
        (content,) = re.findall(r'hlr\.unpack\("\w+", "(.*)"\)', path.read_text())
        assert zlib.decompress(base64.b64decode(content)).startswith(b"drawn a-")


def test_what_is_unchanged_is_not_touched(tmp_path):
    found = report(source("a", drawing("a.svg")), source("b", drawing("b.svg")))
    page = written(found, tmp_path)
    before = state_of(tmp_path)
    written(found, tmp_path)
    assert state_of(tmp_path) == before
    # One drawing is another, one is gone: the scripts of both say so, and nothing else is left.
    first = scripts_of(page)
    (tmp_path / "a.svg").write_text("<svg/>")
    written(report(source("a", drawing("a.svg", warning="new"))), tmp_path)
    second = scripts_of(page)
    assert len(first) == 2 and len(second) == 1
    assert "Warned <b>1</b>" in page.read_text()
    (name,) = second
    assert second[name].stat().st_ino != before[first[name]][0]


def test_an_unchanged_drawing_keeps_its_script_when_the_page_is_made_anew(tmp_path):
    page = written(report(source("a", drawing("a.svg"))), tmp_path)
    (script,) = scripts_of(page).values()
    before = script.stat().st_ino
    written(report(source("a", drawing("a.svg", warning="new"))), tmp_path)
    assert script.stat().st_ino == before


def test_no_name_becomes_markup(tmp_path):
    found = report(
        source(HOSTILE, drawing("a.svg", view=HOSTILE, warning=HOSTILE)),
        source("b", error=HOSTILE),
        gone=[HOSTILE],
        others=[{"file": f"{HOSTILE}.svg", "source": HOSTILE}],
        stale=[{"file": f"{HOSTILE}.png", "source": f"gone {HOSTILE}"}],
    )
    page = written(found, tmp_path)
    text = page.read_text()
    assert "alert(1)" in text and "<script>" not in text and "<img src=x" not in text
    script = (tmp_path / "page/data.js").read_text()
    assert "alert(1)" in script and not set("<>&") & set(script)
    assert data("\u2028") == b'hlr.batch = "\\u2028";\n'


def test_files_with_odd_names_have_addresses():
    (card,) = cards(report(source("a#b", drawing("50% #1?/ä b.svg"))))
    assert card.picture == "./50%25%20%231%3F/%C3%A4%20b.svg"


def test_cards_say_how_it_went():
    changed = {"state": "changed", "summary": "3 mm gone", "before": "baseline/a.svg", "overlay": "o.svg"}
    found = report(
        source("a", drawing("a.svg", change=changed), drawing("a.png", view="top", warning="beware")),
        source("b", error="no."),
        source("c", drawing("c.dxf"), options={"parameters": {"size": 3}}),
    )
    found["sources"][2]["drawings"][0]["files"] = {"dxf": "c.dxf"}
    first, second, failed, plain = cards(found)
    assert (first.state, first.change) == ("drawn", "changed")
    assert first.details["change"]["before"] == "./baseline/a.svg"
    assert (second.state, failed.state, failed.error) == ("warned", "failed", "no.")
    assert (plain.name, plain.picture, plain.svg) == ("c size=3, front", "", "")
    assert len({card.key for card in (first, second, failed, plain)}) == 4


def test_drawings_of_earlier_runs_are_told_apart(tmp_path):
    others = [{"file": f"sub/b-iso.{ending}", "source": "b.step"} for ending in ("pdf", "svg")]
    found = report(source("a", drawing("a.svg")), others=others, stale=[{"file": "c.dxf", "source": "gone.step"}])
    _, other, stale = cards(found)
    assert (other.name, other.state, other.svg) == ("b.step, b-iso", "earlier", "sub/b-iso.svg")
    assert other.details["files"] == [["svg", "./sub/b-iso.svg"], ["pdf", "./sub/b-iso.pdf"]]
    assert (stale.name, stale.state, stale.picture) == ("gone.step, c", "stale", "")
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/b-iso.svg").write_text("<svg/>")
    text = written(found, tmp_path).read_text()
    assert "Earlier <b>1</b>" in text and "Stale <b>1</b>" in text
    assert text.count("<time>") == 1
    # Its script is there, and has the name that it had when the drawing was one of the run.
    before = cards(report(source("b", drawing("sub/b-iso.svg"))))[0].key
    assert f"{before}.js" in scripts_of(tmp_path / "index.html")


def test_a_run_of_a_part_of_a_batch_keeps_the_others_on_the_page(tmp_path):
    for name in ("a", "b"):
        tetrahedron(tmp_path / f"{name}.off")

    def page(files):
        asked = plan(manifest_of({"views": ["iso"], "files": files}, tmp_path), tmp_path / "out")
        done = run(asked, Kept(None, Digests()), FakePool(), Silent())
        write(done, Digests(), {}, earlier=earlier(asked))
        return (tmp_path / "out/index.html").read_text()

    assert "Earlier" not in page(["a.off", "b.off"])
    for _ in range(2):
        text = page(["a.off"])
        assert text.count('<li class="card"') == 2 and text.count('data-state="earlier"') == 1
    assert "Earlier" not in page(["b.off", "a.off"])
