"""One job of a script, in this process."""

import sys

import pytest

from hlr.batch.carry_out import carry_out
from hlr.batch.manifest import manifest_of
from hlr.batch.plan import plan

pytest.importorskip("cadquery")

SCRIPT = "import cadquery as cq\nimport sizes\nsize = 10\nresult = cq.Workplane().box(size, sizes.width, 5)\n"


@pytest.mark.slow
def test_the_variants_of_a_script_and_what_they_import(tmp_path):
    (tmp_path / "part.py").write_text(SCRIPT)
    (tmp_path / "sizes.py").write_text("width = 20\n")
    found = manifest_of({"files": "part.py", "views": "top", "scale": 1, "parameters": {"size": [10, 30]}}, tmp_path)
    outcomes = [carry_out(job) for job in plan(found, tmp_path / "out").jobs]
    assert [outcome.drawings[0]["width_mm"] for outcome in outcomes] == pytest.approx([10.0, 30.0])
    assert [outcome.depends for outcome in outcomes] == [("sizes.py",), ("sizes.py",)]
    assert "sizes" not in sys.modules and outcomes[0].contents[0][0] != outcomes[1].contents[0][0]
    # What is imported is what is there now.
    (tmp_path / "sizes.py").write_text("width = 200\n")
    (again,) = (carry_out(job) for job in plan(found, tmp_path / "out").jobs[:1])
    assert again.drawings[0]["height_mm"] == pytest.approx(200.0)


def test_a_source_that_is_not_there_is_named_from_the_folder_of_the_batch(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/a.off").symlink_to("nowhere.off")
    (job,) = plan(manifest_of({"files": "sub", "views": "top"}, tmp_path), tmp_path / "out").jobs
    failure = carry_out(job).failure
    assert failure and failure.message == "sub/a.off does not exist: check the name and the folder."


def test_links_that_lead_to_one_another_are_named(tmp_path):
    (tmp_path / "a.off").symlink_to("b.off")
    (tmp_path / "b.off").symlink_to("a.off")
    jobs = plan(manifest_of({"views": "top"}, tmp_path), tmp_path / "out").jobs
    failures = [carry_out(job).failure for job in jobs]
    message = "{} does not exist: check the name and the folder."
    assert [failure and failure.message for failure in failures] == [
        message.format(name) for name in ("a.off", "b.off")
    ]
