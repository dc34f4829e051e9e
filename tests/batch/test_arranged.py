"""`arrange` in a manifest: all views of a source on one page."""

from __future__ import annotations

import pytest

from hlr.batch.carry_out import carry_out
from hlr.batch.keys import Digests, key_of
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan
from hlr.errors import OptionError

MESH = "OFF\n4 4 0\n0 0 0\n30 0 0\n0 20 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


def jobs(folder, **keys):
    (folder / "part.off").write_text(MESH)
    found = manifest_of({"files": "part.off", **keys}, folder)
    return found, plan(found, folder / "out").jobs


@pytest.mark.parametrize(
    ("keys", "views"),
    [
        ({"arrange": "third-angle"}, ("front", "top", "right", "iso")),
        ({"arrange": "first-angle"}, ("front", "top", "left", "iso")),
        ({"arrange": "first-angle", "views": ["front", [1, 2, 3]]}, ("front", (1, 2, 3))),
    ],
)
def test_one_file_holds_all_views(tmp_path, keys, views):
    _, (job,) = jobs(tmp_path, formats=["svg", "pdf"], **keys)
    name = f"./part-{keys['arrange']}"
    assert job.views == views
    assert [[file.removeprefix("./") for file in row] for row in job.files] == [[f"{name[2:]}.svg", f"{name[2:]}.pdf"]]
    outcome = carry_out(job)
    assert outcome.failure is None
    ((svg, pdf),) = outcome.contents
    assert svg.count(b"<view ") == len(views)
    assert pdf.startswith(b"%PDF")
    assert [drawing["view"] for drawing in outcome.drawings] == [keys["arrange"]]


def test_another_method_is_another_drawing(tmp_path):
    keys = {
        key_of(jobs(tmp_path, arrange=method, views="front")[1][0], Digests())
        for method in ("", "first-angle", "third-angle")
    }
    assert len(keys) == 3


def test_a_source_may_have_pages_for_each_view_again(tmp_path):
    (tmp_path / "part.off").write_text(MESH)
    (tmp_path / "other.off").write_text(MESH)
    sources = [{"files": "part.off"}, {"files": "other.off", "arrange": ""}]
    found = manifest_of({"arrange": "third-angle", "source": sources}, tmp_path)
    one, other = plan(found, tmp_path / "out").jobs
    assert len(one.files) == 1
    assert len(other.files) == len(other.views) == 4


def test_a_method_that_does_not_exist(tmp_path):
    with pytest.raises(OptionError, match="first-angle or third-angle, or an empty text is needed, not 'second'"):
        jobs(tmp_path, arrange="second")
